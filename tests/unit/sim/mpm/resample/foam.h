#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/mpm/resample/avoid_void.h"
#include "sim/mpm/step.h"

namespace lather::testing_support {

/// Points put by hand into the sets of a scene, to be resampled: cells of 2 m, so that r is 1 m, in a domain
/// from -24 to 24 m; two materials, "a" and "b".
class Foam {
 public:
  explicit Foam(int dimension, bool periodic = false);
  /// Material "a" does not tear, so that its points hold fewer fields than those of "b".
  static Foam with_untearing_a(int dimension) { return Foam(dimension, false, "\"infinity\""); }

  /// Adds a point, id by id from 0.
  void add(const Vec3& x, std::size_t set = 0, const Vec3& v = Vec3::Zero());
  /// A lattice of points at integers plus `shift` wherever inside(x) holds.
  template <class Inside>
  void fill(const Vec3& shift, const Inside& inside, std::size_t set = 0) {
    const int z = dimension_ == 3 ? 24 : 0;
    for (int i = -24; i < 24; ++i)
      for (int j = -24; j < 24; ++j)
        for (int k = -z; k < std::max(z, 1); ++k) {
          Vec3 x = Vec3(i, j, k) + shift;
          if (dimension_ == 2) x.z() = 0;
          if (inside(x)) add(x, set);
        }
  }

  /// Sorts the sets and bins their points.
  mpm::resample::PointBins bins();
  /// Runs the whole of "avoid a void" once, with the random numbers of step `step`.
  mpm::resample::Outcome avoid_void(std::uint64_t step);

  [[nodiscard]] std::vector<Vec3> positions(std::size_t set = 0) const;
  [[nodiscard]] double shares(std::size_t set = 0) const;  ///< their sum
  [[nodiscard]] Vec3 momentum() const;                     ///< sum of share times velocity

  std::vector<ParticleSet<double>> sets;
  mpm::resample::Resampler resampler;
  std::uint32_t next_id = 0;

 private:
  Foam(int dimension, bool periodic, const char* tear_threshold_of_a);
  void sort();

  int dimension_;
  std::unique_ptr<mpm::Model<double>> model_;
  mpm::BlockGrid<double> grid_;
};

}  // namespace lather::testing_support
