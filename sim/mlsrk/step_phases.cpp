// Diffusion in a step [MLSRK eq. 13-16].

#include <cmath>

#include "sim/mlsrk/tile_loops.h"

namespace lather::mlsrk {

/// What the points show their neighbours; the value is c, or the potential once that is known.
template <class Real>
void Stepper<Real>::show_concentrations(State<Real>& state) {
  const bool by_volume = model_.scene.numerics.mlsrk.phases.balance == PhaseBalance::kConcentration;
  for_set_tiles(Stage::kPhases, [&](const TileOfSet& at) {
    const std::optional<Phase>& phase = model_.scene.materials[at.set].phase;
    if (!phase) return;
    const double* c = state.sets[at.set].template values<double>(at.tile, Field::kConcentration);
    for_points(state, at, [&](int lane, std::uint32_t slot) {
      shown(slot, PhaseRows::kValue) = static_cast<Real>(c[lane]);
      shown(slot, PhaseRows::kMember) = Real(1);
      const Real amount = by_volume ? cloud_.volume(slot) : model_.materials[at.set].mass;
      shown(slot, PhaseRows::kMobility) = amount * static_cast<Real>(phase->mobility);
    });
  });
}

template <class Real>
void Stepper<Real>::diffuse(State<Real>& state, double dt) {
  const PhaseNumerics& n = model_.scene.numerics.mlsrk.phases;
  const double width = n.interface_width.value_or(cloud_.scale());
  const PhaseStep<Real> step = {static_cast<Real>(1 / cloud_.scale()), static_cast<Real>(width * width),
                                n.free_energy == FreeEnergy::kDoubleWell};
  const PhaseKernels<Real>& kernels = model_.phases;
  const auto shape_reals = static_cast<std::size_t>(model_.kernels.shape_reals) * kTile;
  const auto flux_reals = static_cast<std::size_t>(kernels.flux_reals) * kTile;
  show_concentrations(state);
  on_tiles(Stage::kPhases, [&](std::size_t t, const Surroundings<Real>& around) {
    kernels.potentials(step, around, shape_.data() + t * shape_reals, phase_.data(),
                       potential_.data() + t * kTile);
  });
  for_set_tiles(Stage::kPhases, [&](const TileOfSet& at) {
    if (!model_.scene.materials[at.set].phase) return;  // their rows stay 0
    for_points(state, at,
               [&](int, std::uint32_t slot) { shown(slot, PhaseRows::kValue) = potential_[slot]; });
  });
  std::vector<Real>& returned = potential_;  // no longer needed itself
  on_tiles(Stage::kPhases, [&](std::size_t t, const Surroundings<Real>& around) {
    kernels.fluxes(step, around, shape_.data() + t * shape_reals, phase_.data(),
                   flux_.data() + t * flux_reals, returned.data() + t * kTile);
  });
  on_tiles(Stage::kPhases, [&](std::size_t t, const Surroundings<Real>& around) {
    kernels.gains(step, around, flux_.data(), gain_.data() + t * kTile, lumped_volume_.data() + t * kTile);
  });
  for_set_tiles(Stage::kPhases, [&](const TileOfSet& at) {
    if (!model_.scene.materials[at.set].phase) return;
    double change[kTile] = {};
    for_points(state, at, [&](int lane, std::uint32_t slot) {
      change[lane] = dt * static_cast<double>(gain_[slot] + returned[slot]) / inertia(at.set, slot);
    });
    model_.laws[at.set].change_concentration(set_tile(state, at), change);
  });
}

/// What a gain is divided by, for the rate of c.
template <class Real>
double Stepper<Real>::inertia(std::uint32_t set, std::uint32_t slot) const {
  const PhaseBalance balance = model_.scene.numerics.mlsrk.phases.balance;
  const auto mass = static_cast<double>(model_.materials[set].mass);
  if (balance == PhaseBalance::kMass) return mass;
  const auto own = static_cast<double>(cloud_.volume(slot));
  const double lumped =
      static_cast<double>(lumped_volume_[slot]) * std::pow(cloud_.scale(), model_.scene.dimension);
  const double volume = lumped >= 0.1 * own ? lumped : own;  // few neighbours can make it 0, or less
  return balance == PhaseBalance::kConcentration ? volume : mass / own * volume;
}

template void Stepper<float>::diffuse(State<float>&, double);
template void Stepper<double>::diffuse(State<double>&, double);

}  // namespace lather::mlsrk
