#include "sim/snapshot.h"

#include <algorithm>
#include <array>

namespace lather {
namespace {

/// Where a point stands in its set.
struct Slot {
  std::uint32_t id;
  std::uint32_t lane;
  std::size_t tile;
};

template <class Real>
std::vector<Slot> slots_by_id(const ParticleSet<Real>& set) {
  std::vector<Slot> slots;
  slots.reserve(set.size());
  for (std::size_t t = 0; t < set.tiles(); ++t)
    for (std::uint32_t lane = 0; lane < kTile; ++lane)
      if (const std::uint32_t id = set.template values<std::uint32_t>(t, Field::kId)[lane]; id != kNoPoint)
        slots.push_back({id, lane, t});
  std::sort(slots.begin(), slots.end(), [](const Slot& a, const Slot& b) { return a.id < b.id; });
  return slots;
}

std::array<float, 3> as_float(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

template <class Real>
double scalar_of(const ParticleSet<Real>& set, const Material& material, const Slot& s,
                 const std::string& name) {
  const auto lane = static_cast<int>(s.lane);
  if (name == "speed") return set.velocity(s.tile, lane).norm();
  if (name == "J") return 1 + set.volume_change(s.tile, lane);
  // What a material does not keep is 0.
  if (name == "concentration")
    return set.layout().has(Field::kConcentration)
               ? set.template values<double>(s.tile, Field::kConcentration)[lane]
               : 0;
  const auto kept = [&](Field f) {
    return set.layout().has(f) ? set.template values<Real>(s.tile, f)[lane] : Real(0);
  };
  if (name == "plastic_strain") return static_cast<double>(kept(Field::kPlasticStrain));
  const Real plasticity = kept(Field::kPlasticity);
  if (name == "plasticity") return static_cast<double>(plasticity);
  return plasticity > static_cast<Real>(material.tearing.tear_threshold) ? 1 : 0;
}

}  // namespace

template <class Real>
Frame Snapshot::take(const std::vector<ParticleSet<Real>>& sets, double time, const Plan& plan,
                     int index) const {
  Frame f = scenery_.frame(index, time);
  for (const std::string& name : plan.scalars)
    f.points.scalars.push_back({name, name == "speed" ? "m/s" : "1", {}});
  for (std::size_t m = 0; m < sets.size(); ++m) {
    for (const Slot& s : slots_by_id(sets[m])) {
      const auto lane = static_cast<int>(s.lane);
      f.points.position.push_back(as_float(sets[m].position(s.tile, lane)));
      f.points.velocity.push_back(as_float(sets[m].velocity(s.tile, lane)));
      f.points.id.push_back(s.id);
      f.points.material.push_back(static_cast<std::uint8_t>(m));
      for (PointScalar& scalar : f.points.scalars)
        scalar.values.push_back(
            static_cast<float>(scalar_of(sets[m], plan.scene.materials[m], s, scalar.name)));
    }
  }
  return f;
}

template Frame Snapshot::take(const std::vector<ParticleSet<float>>&, double, const Plan&, int) const;
template Frame Snapshot::take(const std::vector<ParticleSet<double>>&, double, const Plan&, int) const;

}  // namespace lather
