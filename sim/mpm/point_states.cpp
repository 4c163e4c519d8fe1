#include "sim/mpm/point_states.h"

namespace lather::mpm {
namespace {

/// J - 1 and B = be - I of one point: xx yy zz xy, and in 3D xz yz.
template <class Real>
void read_law_state(const ParticleSet<Real>& set, std::size_t tile, int lane, Real* law_state) {
  law_state[0] = set.template values<Real>(tile, Field::kVolumeChange)[lane];
  const int components = set.layout().components[static_cast<int>(Field::kElasticStrain)];
  for (int c = 0; c < components; ++c)
    law_state[1 + c] = set.template values<Real>(tile, Field::kElasticStrain, c)[lane];
}

}  // namespace

template <class Real>
std::array<double, 6> law_stress(const ParticleSet<Real>& set, const MaterialConstants<Real>& material,
                                 const PointKernels<Real>& kernels, std::size_t tile, int lane) {
  Real law_state[7] = {};
  Real tau[6];
  read_law_state(set, tile, lane, law_state);
  kernels.stress(material.law, law_state, tau);
  std::array<double, 6> stress{};
  for (std::size_t c = 0; c < 6; ++c) stress[c] = static_cast<double>(tau[c]);
  return stress;
}

template <class Real>
void visit_states(const State<Real>& state, const Model<Real>& model, const PointKernels<Real>& kernels,
                  const std::function<void(const PointState&)>& visit) {
  for (std::size_t m = 0; m < state.sets.size(); ++m) {
    const ParticleSet<Real>& set = state.sets[m];
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        PointState point;
        point.id = set.template values<std::uint32_t>(t, Field::kId)[lane];
        if (point.id == kNoPoint) continue;
        point.material = static_cast<std::uint32_t>(m);
        point.position = set.position(t, lane);
        point.velocity = set.velocity(t, lane);
        point.stress = law_stress(set, model.materials[m], kernels, t, lane);
        visit(point);
      }
  }
}

template std::array<double, 6> law_stress(const ParticleSet<float>&, const MaterialConstants<float>&,
                                          const PointKernels<float>&, std::size_t, int);
template std::array<double, 6> law_stress(const ParticleSet<double>&, const MaterialConstants<double>&,
                                          const PointKernels<double>&, std::size_t, int);
template void visit_states(const State<float>&, const Model<float>&, const PointKernels<float>&,
                           const std::function<void(const PointState&)>&);
template void visit_states(const State<double>&, const Model<double>&, const PointKernels<double>&,
                           const std::function<void(const PointState&)>&);

}  // namespace lather::mpm
