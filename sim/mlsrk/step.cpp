#include "sim/mlsrk/step.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"
#include "sim/mlsrk/tile_loops.h"

namespace lather::mlsrk {
namespace {

template <class Real>
bool is_light(Real lumped, Real own) {
  return !(lumped >= own * static_cast<Real>(kLightest));
}

}  // namespace

template <class Real>
StepExtremes Stepper<Real>::step(State<Real>& state, double dt) {
  sort_when_drifted(state);
  obstacles_.place(state.time, dt);
  grips_.place(state.time, dt);
  find_neighbours(state);
  state.regularized += compute_shape_functions();     // [MLSRK eq. 8, 32]
  if (model_.swells) weigh_crowding(state);           // [MLSRK eq. 19, 30]
  if (model_.corrects) fill_solids();                 // [MLSRK eq. 19]
  compute_stress(state);                              // [MLSRK eq. 19, 22, 23]
  const bool inside = update_velocities(state, dt);   // [MLSRK eq. 11]
  compute_gradients();                                // [MLSRK eq. 12, 18]
  if (model_.scene.has_phases()) diffuse(state, dt);  // [MLSRK eq. 13-16, 30, 31]
  StepExtremes seen = update_points(state, dt);       // [MLSRK eq. 17, 24-29]
  seen.carried_out = !inside;
  state.drift += seen.largest_cells;
  state.max_speed = seen.max_speed;
  state.time += dt;
  ++state.step;
  return seen;
}

template <class Real>
Stepper<Real>::Stepper(const Model<Real>& model, int threads)
    : model_(model),
      threads_(threads),
      obstacles_(model.scene, model.scene.spacing),
      grips_(model.scene),
      cloud_(model.scene),
      clock_(threads),
      scratch_(static_cast<std::size_t>(threads)) {}

template <class Real>
void Stepper<Real>::sort_when_drifted(State<Real>& state) {
  // Tiles that are not there yet (after a restore) are made anew from the sets as they were sorted.
  const bool sort = !state.sorted || state.drift > kDriftMargin;
  if (!sort && !cloud_.empty()) return;
  clock_.time(Stage::kSort, [&] {
    if (sort) {
      for (std::size_t m = 0; m < state.sets.size(); ++m) {
        const Departures left = state.sets[m].sort(model_.bounds, threads_);
        state.left[m].points += left.points;
        state.left[m].shares += left.shares;
        state.sets[m].order_within_blocks(threads_);
      }
      state.sorted = true;
      state.drift = 0;
    }
    cloud_.build(state.sets, model_.bounds);
    const std::size_t slots = cloud_.slots();
    const auto dim = static_cast<std::size_t>(model_.scene.dimension);
    velocity_.assign(slots * kVelocityRows, Real(0));
    shape_.assign(slots * static_cast<std::size_t>(model_.kernels.shape_reals), Real(0));
    stress_.assign(slots * kStressReals, Real(0));
    crowding_.assign(slots, Real(0));
    gradient_.assign(slots * dim * dim, Real(0));
    smooth_.assign(slots * dim, Real(0));
    if (model_.scene.has_phases()) {
      phase_.assign(slots * PhaseRows::kCount, Real(0));
      potential_.assign(slots, Real(0));
      flux_.assign(slots * static_cast<std::size_t>(model_.phases.flux_reals), Real(0));
      gain_.assign(slots, Real(0));
      lumped_volume_.assign(slots, Real(0));
    }
    set_tiles_.clear();
    for (std::uint32_t s = 0; s < state.sets.size(); ++s)
      for (std::uint32_t t = 0; t < state.sets[s].tiles(); ++t) set_tiles_.push_back({s, t});
    if (!grips_.none()) note_grips(state);
  });
}

template <class Real>
void Stepper<Real>::note_grips(const State<Real>& state) {
  grip_.assign(cloud_.slots(), 0);
  for (const TileOfSet& at : set_tiles_) {
    const ParticleSet<Real>& set = state.sets[at.set];
    if (!set.layout().has(Field::kGrip)) continue;
    const std::uint32_t* entries = set.template values<std::uint32_t>(at.tile, Field::kGrip);
    for_points(state, at, [&](int lane, std::uint32_t slot) { grip_[slot] = entries[lane]; });
  }
}

template <class Real>
SetTile<Real> Stepper<Real>::set_tile(State<Real>& state, const TileOfSet& at) const {
  ParticleSet<Real>& set = state.sets[at.set];
  return {set.tile(at.tile), &set.layout(), &model_.materials[at.set]};
}

template <class Real>
void Stepper<Real>::find_neighbours(State<Real>& state) {
  clock_.time(Stage::kNeighbours, [&] { cloud_.refresh(state.sets, threads_); });
  parallel_for(threads_, static_cast<std::int64_t>(set_tiles_.size()), 64, [&](std::int64_t index) {
    clock_.time(Stage::kNeighbours, [&] {
      const TileOfSet& at = set_tiles_[static_cast<std::size_t>(index)];
      const SetTile<Real> tile = set_tile(state, at);
      Real volume[kTile];
      model_.laws[at.set].volumes(tile, volume);
      for_points(state, at, [&](int lane, std::uint32_t slot) {
        cloud_.put_volume(slot, volume[lane]);
        for (int a = 0; a < model_.scene.dimension; ++a)
          velocity(slot, a) = state.sets[at.set].template values<Real>(at.tile, Field::kVelocity, a)[lane];
        velocity(slot, 3) = tile.material->mass;
      });
    });
  });
}

template <class Real>
std::uint64_t Stepper<Real>::compute_shape_functions() {
  const auto reals = static_cast<std::size_t>(model_.kernels.shape_reals) * kTile;
  const auto one_tile = [&](std::int64_t index) {
    const auto t = static_cast<std::size_t>(index);
    std::uint64_t regularized = 0;
    clock_.time(Stage::kShapeFunctions, [&] {
      Real fallen[kTile];
      model_.kernels.shape_functions(model_.shape, cloud_.around(t, scratch().nearby),
                                     shape_.data() + t * reals, crowding_.data() + t * kTile, fallen);
      for (int i = 0; i < cloud_.tiles()[t].count; ++i) regularized += fallen[i] != Real(0) ? 1 : 0;
    });
    return regularized;
  };
  return parallel_fold(threads_, static_cast<std::int64_t>(cloud_.tiles().size()), std::uint64_t{0}, one_tile,
                       [](std::uint64_t& sum, std::uint64_t part) { sum += part; });
}

template <class Real>
void Stepper<Real>::weigh_crowding(State<Real>& state) {
  for_set_tiles(Stage::kShapeFunctions, [&](const TileOfSet& at) {
    Real ratio[kTile];
    model_.laws[at.set].swelling(set_tile(state, at), ratio);
    for_points(state, at, [&](int lane, std::uint32_t slot) { potential_[slot] = ratio[lane]; });
  });
  on_tiles(Stage::kShapeFunctions, [&](std::size_t t, const Surroundings<Real>& around) {
    model_.phases.crowding(around, potential_.data(), crowding_.data() + t * kTile);
  });
}

template <class Real>
void Stepper<Real>::compute_stress(State<Real>& state) {
  const auto stress_of = [&](std::int64_t index) {
    const TileOfSet& at = set_tiles_[static_cast<std::size_t>(index)];
    double stiffest = 1;
    clock_.time(Stage::kStress, [&] {
      const SetTile<Real> tile = set_tile(state, at);
      if (tile.material->corrected) {
        Real change[kTile] = {};
        for_points(state, at, [&](int lane, std::uint32_t slot) {
          change[lane] = (model_.lattice_crowding - crowding_[slot]) / crowding_[slot];
        });
        model_.laws[at.set].correct(tile, change);
      }
      Real rows[kTile * kStressReals];
      stiffest = static_cast<double>(model_.laws[at.set].stress(tile, rows)) * model_.wave_shares[at.set];
      for_points(state, at, [&](int lane, std::uint32_t slot) {
        std::copy_n(rows + lane * kStressReals, kStressReals,
                    stress_.data() + std::size_t{slot} * kStressReals);
      });
    });
    return stiffest;
  };
  state.stiffest = parallel_fold(threads_, static_cast<std::int64_t>(set_tiles_.size()), 1.0, stress_of,
                                 [](double& most, double part) { most = std::max(most, part); });
}

/// False where a grip takes a point through a face of the domain.
template <class Real>
bool Stepper<Real>::update_velocities(State<Real>& state, double dt) {
  const Scene& scene = model_.scene;
  MomentumStep<Real> step{};
  step.dt = static_cast<Real>(dt);
  for (int a = 0; a < 3; ++a) step.gravity[a] = static_cast<Real>(scene.gravity[a]);
  step.inverse_scale = static_cast<Real>(1 / cloud_.scale());
  step.own_mass = scene.numerics.mlsrk.inertial_mass == InertialMass::kOwn;
  struct Seen {
    double change_squared = 0;
    std::uint64_t light = 0;
    bool inside = true;
  };
  const auto one_tile = [&](std::int64_t index) {
    const auto t = static_cast<std::size_t>(index);
    Seen seen;
    clock_.time(Stage::kMomentum, [&] { seen.change_squared = accelerate(t, step, scratch(), seen.light); });
    clock_.time(Stage::kParticleCollisions, [&] {
      resolve_collisions(t, dt, scratch());
      if (!grips_.none()) seen.inside = drive_points(t, dt);
    });
    return seen;
  };
  const Seen seen = parallel_fold(threads_, static_cast<std::int64_t>(cloud_.tiles().size()), Seen{},
                                  one_tile, [](Seen& sum, const Seen& part) {
                                    sum.change_squared = std::max(sum.change_squared, part.change_squared);
                                    sum.light += part.light;
                                    sum.inside = sum.inside && part.inside;
                                  });
  state.light += seen.light;
  state.max_acceleration = std::sqrt(seen.change_squared) / dt;
  return seen.inside;
}

/// Returns the largest squared change of a velocity that no grip prescribes, (m/s)^2.
template <class Real>
double Stepper<Real>::accelerate(std::size_t tile, const MomentumStep<Real>& step, Scratch& scratch,
                                 std::uint64_t& light) {
  Real lumped[kTile];
  Real before[kTile * kVelocityRows];
  Real* rows = velocity_.data() + tile * kTile * kVelocityRows;
  std::copy_n(rows, kTile * kVelocityRows, before);
  model_.kernels.momentum(step, cloud_.around(tile, scratch.nearby), shape_.data(), stress_.data(), rows,
                          lumped);
  double largest = 0;
  for (int i = 0; i < cloud_.tiles()[tile].count; ++i) {
    light += is_light(lumped[i], rows[3 * kTile + i]) ? 1 : 0;
    if (driven(tile * kTile + static_cast<std::size_t>(i))) continue;
    double squared = 0;
    for (int a = 0; a < 3; ++a) {
      const auto change = static_cast<double>(rows[a * kTile + i] - before[a * kTile + i]);
      squared += change * change;
    }
    largest = std::max(largest, squared);
  }
  return largest;
}

template <class Real>
LumpedMeasure Stepper<Real>::measure_lumped(State<Real>& state) {
  sort_when_drifted(state);
  find_neighbours(state);
  (void)compute_shape_functions();
  // Rows without stress: forces are not wanted, masses are what compute_stress() writes.
  std::fill(stress_.begin(), stress_.end(), Real(0));
  for (std::size_t slot = 0; slot < cloud_.slots(); ++slot)
    stress_[slot * kStressReals + kStressReals - 1] = velocity(slot, 3);
  const auto one_tile = [&](std::int64_t index) {
    const auto t = static_cast<std::size_t>(index);
    Real lumped[kTile];
    Real rows[kTile * kVelocityRows];
    std::copy_n(velocity_.data() + t * kTile * kVelocityRows, kTile * kVelocityRows, rows);
    model_.kernels.momentum({}, cloud_.around(t, scratch().nearby), shape_.data(), stress_.data(), rows,
                            lumped);
    LumpedMeasure part;
    for (int i = 0; i < cloud_.tiles()[t].count; ++i) {
      const std::size_t slot = t * kTile + static_cast<std::size_t>(i);
      const Real own = velocity(slot, 3);
      const auto mass = static_cast<double>(is_light(lumped[i], own) ? own : lumped[i]);
      part.mass += mass;
      for (int a = 0; a < model_.scene.dimension; ++a) {
        const auto u = static_cast<double>(velocity(slot, a));
        part.momentum[static_cast<std::size_t>(a)] += mass * u;
        part.kinetic_energy += 0.5 * mass * u * u;
      }
    }
    return part;
  };
  return parallel_fold(threads_, static_cast<std::int64_t>(cloud_.tiles().size()), LumpedMeasure{}, one_tile,
                       [](LumpedMeasure& sum, const LumpedMeasure& part) {
                         sum.mass += part.mass;
                         sum.kinetic_energy += part.kinetic_energy;
                         for (std::size_t a = 0; a < 3; ++a) sum.momentum[a] += part.momentum[a];
                       });
}

template <class Real>
void Stepper<Real>::compute_gradients() {
  const auto shape_reals = static_cast<std::size_t>(model_.kernels.shape_reals) * kTile;
  const auto dim = static_cast<std::size_t>(model_.scene.dimension);
  const auto inverse_scale = static_cast<Real>(1 / cloud_.scale());
  on_tiles(Stage::kVelocityGradients, [&](std::size_t t, const Surroundings<Real>& around) {
    model_.kernels.gradients(model_.shape, inverse_scale, around, shape_.data() + t * shape_reals,
                             velocity_.data(), gradient_.data() + t * dim * dim * kTile,
                             smooth_.data() + t * dim * kTile);
  });
}

template <class Real>
StepExtremes Stepper<Real>::update_points(State<Real>& state, double dt) {
  const Mlsrk& n = model_.scene.numerics.mlsrk;
  MoveStep<Real> move{};
  move.dt = static_cast<Real>(dt);
  move.cell = static_cast<Real>(model_.scene.spacing);
  move.blend = static_cast<Real>(1 - std::pow(n.velocity_blend, dt / n.velocity_blend_reference_step));
  move.phase = rounding_phase<Real>(state.step);
  const int dim = model_.scene.dimension;
  const auto one_tile = [&](std::int64_t index) {
    const TileOfSet& at = set_tiles_[static_cast<std::size_t>(index)];
    const SetTile<Real> tile = set_tile(state, at);
    Real gradient[9 * kTile] = {};
    Real smooth[3 * kTile] = {};
    Real moved[3 * kTile] = {};
    TileExtremes seen;
    clock_.time(Stage::kDeformation, [&] {
      for_points(state, at, [&](int lane, std::uint32_t slot) {
        const std::size_t t = slot / kTile;
        const std::size_t i = slot % kTile;
        const auto reals = static_cast<std::size_t>(dim);
        for (int c = 0; c < dim * dim; ++c)
          gradient[c * kTile + lane] =
              gradient_[(t * reals * reals + static_cast<std::size_t>(c)) * kTile + i];
        const bool blended = !driven(slot);
        for (int a = 0; a < dim; ++a) {
          if (blended)
            smooth[a * kTile + lane] = smooth_[(t * reals + static_cast<std::size_t>(a)) * kTile + i];
          moved[a * kTile + lane] = velocity(slot, a);
        }
      });
      model_.laws[at.set].deform(tile, move.dt, gradient);
    });
    clock_.time(Stage::kPositions, [&] { seen = model_.positions(tile, move, moved, smooth); });
    return StepExtremes{seen.largest_cells, std::sqrt(seen.speed_squared), seen.finite, seen.collapsed,
                        false};
  };
  return parallel_fold(threads_, static_cast<std::int64_t>(set_tiles_.size()), StepExtremes{}, one_tile,
                       [](StepExtremes& sum, const StepExtremes& part) { sum.include(part); });
}

template class Stepper<float>;
template class Stepper<double>;

}  // namespace lather::mlsrk
