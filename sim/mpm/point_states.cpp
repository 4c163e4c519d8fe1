#include "sim/mpm/point_states.h"

namespace lather::mpm {

template <class Real>
std::array<std::array<double, 6>, kTile> law_stress(const ParticleSet<Real>& set,
                                                    const MaterialConstants<Real>& material,
                                                    std::size_t tile) {
  const std::byte* from = set.tile(tile);
  std::vector<std::byte> own(from, from + set.layout().stride);  // kernels take tiles that they may change
  Real tau[6][kTile];
  (void)material.kernels.stress({own.data(), &set.layout(), &material}, tau[0]);
  std::array<std::array<double, 6>, kTile> stress{};
  for (std::size_t lane = 0; lane < kTile; ++lane)
    for (std::size_t c = 0; c < 6; ++c) stress[lane][c] = static_cast<double>(tau[c][lane]);
  return stress;
}

template <class Real>
void visit_states(const State<Real>& state, const Model<Real>& model,
                  const std::function<void(const PointState&)>& visit) {
  for (std::size_t m = 0; m < state.sets.size(); ++m) {
    const ParticleSet<Real>& set = state.sets[m];
    for (std::size_t t = 0; t < set.tiles(); ++t) {
      const auto stress = law_stress(set, model.materials[m], t);
      for (int lane = 0; lane < kTile; ++lane) {
        PointState point;
        point.id = set.template values<std::uint32_t>(t, Field::kId)[lane];
        if (point.id == kNoPoint) continue;
        point.material = static_cast<std::uint32_t>(m);
        point.position = set.position(t, lane);
        point.velocity = set.velocity(t, lane);
        point.stress = stress[static_cast<std::size_t>(lane)];
        visit(point);
      }
    }
  }
}

template std::array<std::array<double, 6>, kTile> law_stress(const ParticleSet<float>&,
                                                             const MaterialConstants<float>&, std::size_t);
template std::array<std::array<double, 6>, kTile> law_stress(const ParticleSet<double>&,
                                                             const MaterialConstants<double>&, std::size_t);
template void visit_states(const State<float>&, const Model<float>&,
                           const std::function<void(const PointState&)>&);
template void visit_states(const State<double>&, const Model<double>&,
                           const std::function<void(const PointState&)>&);

}  // namespace lather::mpm
