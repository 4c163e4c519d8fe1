#pragma once

#include <cstdint>
#include <vector>

#include "sim/collide/contact_sink.h"
#include "sim/particles/particle_set.h"
#include "sim/scene/scene.h"

namespace lather::mpm {

/// What a probe has gathered since its last sample; plain data, saved as it stands.
struct ProbeState {
  std::uint64_t sample = 0;  ///< number of the next sample
  double since = 0;          ///< s, time of the last one
  ContactLoad load;          ///< since then; the moment about the probe's own point
  double passed = 0;         ///< kg through a plane since then
  double passed_before = 0;  ///< kg, before it
};

/// A plane, disc or rectangle in place.
class PlaneFrame {
 public:
  PlaneFrame(const PlaneProbe& probe, int dimension);

  /// Height of x above the plane, m.
  [[nodiscard]] double height(const Vec3& x) const { return normal_.dot(x - probe_.point); }
  /// True when the foot of x lies in the disc, in the rectangle, or anywhere for a plane without edge.
  [[nodiscard]] bool covers(const Vec3& x) const;
  /// Least number of half extents `h` of a box around x that reach the plane: |height| <= reach(half).
  [[nodiscard]] double reach(const Vec3& half) const { return normal_.cwiseAbs().dot(half); }

 private:
  PlaneProbe probe_;
  Vec3 normal_;
  Vec3 along_ = Vec3::Zero();
  Vec3 across_ = Vec3::Zero();
};

/// What steps collect for the probes of a scene: loads on obstacles, crossings of planes. Blocks write rows
/// of their own, which are summed in order, so that no bit depends on the number of threads. Without probes
/// nothing is allocated, and nothing asked but whether there is something to do.
class ProbeTally {
 public:
  ProbeTally(const Scene& scene, int threads);

  [[nodiscard]] bool watches_planes() const { return !planes_.empty(); }

  /// Clears the rows for a step over so many blocks.
  void begin_step(std::size_t grid_blocks, std::size_t point_blocks);

  [[nodiscard]] ContactSink grid_sink(std::size_t block) { return sink(grid_loads_, block); }
  [[nodiscard]] ContactSink point_sink(std::size_t block) { return sink(point_loads_, block); }

  /// Notes where the points of a range are before they move, if some plane is near.
  template <class Real>
  void before_move(const ParticleSet<Real>& set, const BlockRange& range);
  /// Counts those of the same range that have crossed a plane; `mass` is a whole point's, kg.
  template <class Real>
  void after_move(const ParticleSet<Real>& set, const BlockRange& range, double mass, std::size_t block);

  /// Adds what the step that started at `time` (s) collected to the probes' states.
  void end_step(double time, std::vector<ProbeState>& probes) const;

 private:
  [[nodiscard]] ContactSink sink(std::vector<ContactLoad>& loads, std::size_t block) {
    return {watched_, loads.empty() ? nullptr : loads.data() + block * watched_.count};
  }
  [[nodiscard]] ContactLoad total(std::size_t slot) const;

  const Scene& scene_;
  WatchedContacts watched_;
  std::vector<PlaneFrame> planes_;
  std::vector<ContactLoad> grid_loads_;           // [block][slot]
  std::vector<ContactLoad> point_loads_;          // [block][slot]
  std::vector<double> crossed_;                   // [block][plane], kg
  std::vector<std::vector<Vec3>> places_before_;  // per thread; empty: no plane is near
};

/// Where the torque of a probe on `obstacle` is taken about at time `t`, m.
[[nodiscard]] Vec3 torque_point(const ForceProbe& probe, const Obstacle& obstacle, double t);

/// The obstacle of that name, which the scene has.
[[nodiscard]] std::size_t obstacle_index(const Scene& scene, const std::string& name);

}  // namespace lather::mpm
