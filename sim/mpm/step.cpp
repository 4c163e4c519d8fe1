#include "sim/mpm/step.h"

#include <algorithm>
#include <cmath>

#include "sim/math/parallel.h"
#include "sim/mpm/emission.h"
#include "sim/mpm/grid_contact.h"
#include "sim/mpm/interior_voids.h"
#include "sim/mpm/semi_implicit.h"
#include "sim/plan/step_bound.h"

namespace lather::mpm {

namespace {

/// Once in every interval of simulated time: when a step from `before` to `after` crosses a multiple of it. A
/// small tolerance makes steps that divide the interval hit the same multiples whatever their rounding.
bool interval_ends(double interval, double before, double after) {
  const auto intervals = [&](double time) { return std::floor(time / interval + 1e-6); };
  return intervals(after) > intervals(before);
}

}  // namespace

template <class Real>
StepResult Stepper<Real>::step(State<Real>& state, double dt) {
  sort_when_drifted(state);
  const StepConstants<Real> constants = this->constants(state, dt);
  obstacles_.place(state.time, dt);
  plan_recovery(state, dt);
  detect_tearing(state);  // 2
  tally_.begin_step(grid_.grid_blocks().size(), grid_.point_blocks().size());
  SolveFigures solve;
  if (solver_) {
    solve = solve_grid(state, constants);  // 1, 3 to 6
  } else {
    state.stiffest = rasterize(state, constants, model_.materials);  // 1, 3, 4
    update_grid(constants);                                          // 5, 6
  }
  const StepExtremes seen = update_particles(state, constants);  // 7 to 11, 13, 14
  tally_.end_step(state.time, state.probes);
  state.drift += seen.largest_cells;
  state.max_speed = seen.max_speed;
  state.time += dt;
  ++state.step;
  const auto due = [&](const auto& activity) {
    return activity && interval_ends(activity->interval, state.time - dt, state.time);
  };
  if (due(model_.scene.numerics.subgrid_removal)) remove_subgrid(state);  // 12
  if (due(model_.scene.numerics.resampling)) avoid_void(state);           // 15
  return {seen, solve};
}

template <class Real>
Stepper<Real>::Stepper(const Model<Real>& model, int threads)
    : model_(model),
      threads_(threads),
      obstacles_(model.scene, model.scene.spacing),
      tally_(model.scene, threads),
      grid_(model.scene.dimension, model.scene.numerics.transfer == Transfer::kApic),
      clock_(threads),
      scratch_(static_cast<std::size_t>(threads)),
      near_(static_cast<std::size_t>(threads)) {
  for (auto& s : scratch_) s.resize(2 * static_cast<std::size_t>(buffer_reals(model.scene.dimension)));
  if (model.scene.numerics.integration == Integration::kSemiImplicit)
    solver_ = std::make_unique<VelocitySolver<Real>>(model, threads);
}

template <class Real>
Stepper<Real>::~Stepper() = default;

template <class Real>
std::size_t Stepper<Real>::bytes() const {
  return grid_.bytes() + (solver_ ? solver_->bytes() : 0);
}

template <class Real>
void Stepper<Real>::emit(State<Real>& state) {
  if (model_.scene.emitters.empty()) return;
  clock_.time(Stage::kEmit, [&] { emit_due(state, model_.scene); });
}

template <class Real>
void Stepper<Real>::sort_when_drifted(State<Real>& state) {
  // A grid that is not there yet (after a restore) is rebuilt from the ranges as they were saved.
  const bool sort = !state.sorted || state.drift > model_.drift_margin;
  if (!sort && !grid_.point_blocks().empty()) return;
  clock_.time(Stage::kSort, [&] {
    if (sort) {
      state.left.resize(state.sets.size());
      for (std::size_t m = 0; m < state.sets.size(); ++m) {
        const Departures left = state.sets[m].sort(model_.bounds, threads_);
        state.left[m].points += left.points;
        state.left[m].shares += left.shares;
      }
      state.sorted = true;
      state.drift = 0;
    }
    std::vector<const std::vector<BlockRange>*> ranges;
    for (const auto& set : state.sets) ranges.push_back(&set.ranges());
    grid_.rebuild(ranges, model_.bounds, threads_);
  });
}

template <class Real>
StepConstants<Real> Stepper<Real>::constants(const State<Real>& state, double dt) const {
  const Scene& s = model_.scene;
  StepConstants<Real> c;
  c.dt = static_cast<Real>(dt);
  c.cell = static_cast<Real>(s.spacing);
  for (int a = 0; a < 3; ++a) c.gravity[a] = static_cast<Real>(s.gravity[a]);
  c.flip = static_cast<Real>(flip_share(s.numerics, dt));
  c.phase = rounding_phase<Real>(state.step);
  return c;
}

/// Plasticity fades as lambda^exp(-t/eta_p), so recovery over one span t equals recovery over its parts, and
/// need not be computed in every step: a thousandth of the recovery time apart it lags by half as much on
/// average. That saves most of its eigenvalues, and in single precision lets it move F at all where eta_p is
/// long.
template <class Real>
void Stepper<Real>::plan_recovery(State<Real>& state, double dt) {
  constexpr double kInterval = 1e-3;  // of the recovery time
  state.since_recovery.resize(state.sets.size(), 0);
  recovery_exponent_.assign(state.sets.size(), 0);
  for (std::size_t s = 0; s < state.sets.size(); ++s) {
    const TearingParameters& tearing = model_.scene.materials[s].tearing;
    if (!tearing.recovers()) continue;
    double& since = state.since_recovery[s];
    since += dt;
    if (since < kInterval * tearing.recovery_time) continue;
    recovery_exponent_[s] = static_cast<Real>(0.5 * std::expm1(-since / tearing.recovery_time));
    since = 0;
  }
}

template <class Real>
void Stepper<Real>::detect_tearing(State<Real>& state) {
  for (std::size_t s = 0; s < state.sets.size(); ++s) {
    if (!state.sets[s].layout().has(Field::kPlasticity)) continue;
    parallel_for(threads_, static_cast<std::int64_t>(state.sets[s].ranges().size()), 4, [&](std::int64_t r) {
      clock_.time(Stage::kDetectTearing, [&] {
        model_.kernels.detect_tearing(
            block_points(state.sets[s], static_cast<std::int32_t>(r), model_.materials[s]));
      });
    });
  }
}

template <class Real>
double Stepper<Real>::rasterize(State<Real>& state, const StepConstants<Real>& step,
                                const std::vector<MaterialConstants<Real>>& materials) {
  const auto one_block = [&](std::int64_t index) {
    const auto b = static_cast<std::size_t>(index);
    Real stiffest(1);
    clock_.time(Stage::kRasterize, [&] {
      std::fill_n(grid_.momentum_buffer(b), grid_.buffer_stride(), Real(0));
      const BlockPlace place = BlockGrid<Real>::place(grid_.point_blocks()[b].block);
      for (std::size_t s = 0; s < state.sets.size(); ++s)
        if (const std::int32_t range = grid_.range_of(s, b); range >= 0)
          stiffest = std::max(
              stiffest, model_.kernels.scatter(block_points(state.sets[s], range, materials[s]), place, step,
                                               grid_.momentum_buffer(b), grid_.force_buffer(b)));
    });
    return static_cast<double>(stiffest);
  };
  return parallel_fold(threads_, static_cast<std::int64_t>(grid_.point_blocks().size()), 1.0, one_block,
                       [](double& most, double part) { most = std::max(most, part); });
}

template <class Real>
void Stepper<Real>::update_grid(const StepConstants<Real>& step) {
  parallel_for(threads_, static_cast<std::int64_t>(grid_.grid_blocks().size()), 4, [&](std::int64_t index) {
    const auto g = static_cast<std::size_t>(index);
    grid_velocities(g, step);
    clock_.time(Stage::kGridCollisions,
                [&] { resolve_grid_collisions(g, near_[static_cast<std::size_t>(thread_index())]); });
  });
}

template <class Real>
void Stepper<Real>::grid_velocities(std::size_t block, const StepConstants<Real>& step) {
  clock_.time(Stage::kReduce, [&] {
    const Real* momentum[27];
    const Real* force[27];
    for (int n = 0; n < neighbours(model_.scene.dimension); ++n) {
      const std::int32_t b = grid_.grid_blocks()[block].points[static_cast<std::size_t>(n)];
      momentum[n] = b < 0 ? nullptr : grid_.momentum_buffer(static_cast<std::size_t>(b));
      force[n] = b < 0 ? nullptr : grid_.force_buffer(static_cast<std::size_t>(b));
    }
    model_.kernels.reduce(momentum, grid_.node(block));
    if (grid_.increment(block) != nullptr) model_.kernels.reduce(force, grid_.increment(block));
  });
  clock_.time(Stage::kGridVelocities,
              [&] { model_.kernels.update_grid(step, grid_.node(block), grid_.increment(block)); });
}

/// The semi-implicit scheme in place of rasterize() and update_grid(): over a step of no length those give
/// mass and velocity; the solver finds what forces and contact make of them.
template <class Real>
SolveFigures Stepper<Real>::solve_grid(State<Real>& state, const StepConstants<Real>& step) {
  StepConstants<Real> now = step;
  now.dt = 0;
  rasterize(state, now, model_.materials);
  const auto blocks = static_cast<std::int64_t>(grid_.grid_blocks().size());
  parallel_for(threads_, blocks, 4,
               [&](std::int64_t g) { grid_velocities(static_cast<std::size_t>(g), now); });
  const SolveFigures figures = solver_->solve(state, grid_, step, obstacles_, clock_);
  parallel_for(threads_, blocks, 4, [&](std::int64_t g) {
    clock_.time(Stage::kGridCollisions, [&] {
      resolve_grid_collisions(static_cast<std::size_t>(g), near_[static_cast<std::size_t>(thread_index())]);
    });
  });
  return figures;
}

template <class Real>
void Stepper<Real>::resolve_grid_collisions(std::size_t block, std::vector<std::uint32_t>& near) {
  const int dim = model_.scene.dimension;
  Real* nodes = grid_.node(block);
  Real* increments = grid_.increment(block);
  const ContactSink sink = tally_.grid_sink(block);
  for_nodes_near_contact(model_, obstacles_, grid_.grid_blocks()[block].block, nodes, near,
                         [&](int i, const Vec3& x, bool walls) {
                           Real* q = nodes + i * kQuad;
                           Vec3 v = quad_vector(q, dim);
                           const auto mass = static_cast<double>(q[0]);
                           bool changed = obstacles_.resolve(near, x, v, mass, sink);
                           if (walls) changed = model_.walls.resolve(x, v, mass, sink) || changed;
                           if (!changed) return;
                           if (increments != nullptr)
                             for (int a = 0; a < dim; ++a)
                               increments[i * kQuad + 1 + a] += static_cast<Real>(v[a]) - q[1 + a];
                           put_quad_vector(q, dim, v);
                         });
}

template <class Real>
StepExtremes Stepper<Real>::update_particles(State<Real>& state, const StepConstants<Real>& step) {
  const auto update_block = [&](std::int64_t index) {
    const auto b = static_cast<std::size_t>(index);
    const PointBlock& block = grid_.point_blocks()[b];
    const BlockPlace place = BlockGrid<Real>::place(block.block);
    const auto thread = static_cast<std::size_t>(thread_index());
    Real* velocity = scratch_[thread].data();
    Real* increment = velocity + buffer_reals(model_.scene.dimension);
    clock_.time(Stage::kCollect, [&] {
      const Real* nodes[27];
      const Real* increments[27];
      for (int n = 0; n < neighbours(model_.scene.dimension); ++n) {
        const auto g = static_cast<std::size_t>(block.grid[static_cast<std::size_t>(n)]);
        nodes[n] = grid_.node(g);
        increments[n] = grid_.increment(g);
      }
      model_.kernels.collect(nodes, velocity);
      if (increments[0] != nullptr) model_.kernels.collect(increments, increment);
    });
    StepExtremes seen;
    for (std::size_t s = 0; s < state.sets.size(); ++s) {
      const std::int32_t range = grid_.range_of(s, b);
      if (range < 0) continue;
      const BlockPoints<Real> p = block_points(state.sets[s], range, model_.materials[s]);
      const BlockRange& at = state.sets[s].ranges()[static_cast<std::size_t>(range)];
      clock_.time(Stage::kUpdateParticles,
                  [&] { model_.kernels.gather(p, place, step, velocity, increment); });
      if (recovery_exponent_[s] != Real(0))
        clock_.time(Stage::kRecovery, [&] { model_.kernels.recover(p, recovery_exponent_[s]); });
      clock_.time(Stage::kParticleCollisions,
                  [&] { resolve_particle_collisions(s, b, state.sets[s], at, step.dt, near_[thread]); });
      if (tally_.watches_planes()) tally_.before_move(state.sets[s], at);
      clock_.time(Stage::kPositions, [&] {
        const BlockExtremes e = model_.kernels.advance(p, step);
        seen.largest_cells = std::max(seen.largest_cells, e.largest_cells);
        seen.max_speed = std::max(seen.max_speed, std::sqrt(e.speed_squared));
        seen.finite = seen.finite && e.finite;
        seen.collapsed = seen.collapsed || e.collapsed;
      });
      if (tally_.watches_planes())
        tally_.after_move(state.sets[s], at, static_cast<double>(model_.materials[s].mass), b);
    }
    return seen;
  };
  return parallel_fold(threads_, static_cast<std::int64_t>(grid_.point_blocks().size()), StepExtremes{},
                       update_block, [](StepExtremes& sum, const StepExtremes& part) { sum.include(part); });
}

template <class Real>
void Stepper<Real>::resolve_particle_collisions(std::size_t set, std::size_t block, ParticleSet<Real>& points,
                                                const BlockRange& range, double dt,
                                                std::vector<std::uint32_t>& near) {
  const Scene& scene = model_.scene;
  const double h = scene.spacing;
  const int dim = scene.dimension;
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
  for (int a = 0; a < dim;
       ++a) {  // a point may be up to half a cell, plus its drift, outside its block's cells
    low[a] = scene.domain.box.min[a] + (range.block[static_cast<std::size_t>(a)] * kBlockWidth - 1.5) * h;
    high[a] = low[a] + (kBlockWidth + 2) * h;
  }
  obstacles_.find_near(0.5 * (low + high), 0.5 * (high - low).norm(), near);
  const bool walls = model_.walls.near(low, high, h);  // no point moves farther in a step
  if (near.empty() && !walls) return;
  const auto mass = static_cast<double>(model_.materials[set].mass);
  const ContactSink sink = tally_.point_sink(block);
  for (int i = 0; i < range.count; ++i) {
    const auto t = range.tile_of(i);
    const int lane = i % kTile;
    const Vec3 x = points.position(t, lane);
    Vec3 v = points.velocity(t, lane);
    const double own_mass = mass * points.share(t, lane);
    bool changed = obstacles_.resolve(near, x, v, own_mass, sink);
    if (walls) changed = model_.walls.resolve(x, v, own_mass, sink, 0, dt) || changed;
    if (!changed) continue;
    for (int a = 0; a < dim; ++a)
      points.template values<Real>(t, Field::kVelocity, a)[lane] = static_cast<Real>(v[a]);
  }
}

template <class Real>
void Stepper<Real>::rasterize_volume_fraction(State<Real>& state) {
  std::vector<MaterialConstants<Real>> as_volume = model_.materials;
  for (auto& m : as_volume) m.mass = m.volume;
  rasterize(state, constants(state, 0), as_volume);
  parallel_for(threads_, static_cast<std::int64_t>(grid_.grid_blocks().size()), 16, [&](std::int64_t index) {
    const auto g = static_cast<std::size_t>(index);
    const Real* buffers[27];
    for (int n = 0; n < neighbours(model_.scene.dimension); ++n) {
      const std::int32_t b = grid_.grid_blocks()[g].points[static_cast<std::size_t>(n)];
      buffers[n] = b < 0 ? nullptr : grid_.momentum_buffer(static_cast<std::size_t>(b));
    }
    model_.kernels.reduce(buffers, grid_.node(g));
  });
}

template <class Real>
double Stepper<Real>::volume_fraction(std::size_t block, int node) const {
  return static_cast<double>(grid_.node(block)[node * kQuad]) /
         std::pow(model_.scene.spacing, model_.scene.dimension);
}

template <class Real>
void Stepper<Real>::remove_subgrid(State<Real>& state) {
  state.sorted = false;
  sort_when_drifted(state);
  clock_.time(Stage::kRemoveSubgrid, [&] {
    const resample::PointBins bins(state.sets, grid_, model_.bounds, model_.resampler.lattice, threads_);
    const std::vector<std::uint32_t> found =
        resample::find_subgrid_points(bins, state.sets, model_.removal, threads_);
    state.removed.mass += resample::remove_points(found, bins, state.sets, model_.removal.mass);
    state.removed.points += found.size();
    state.sorted = found.empty();
  });
}

template <class Real>
void Stepper<Real>::avoid_void(State<Real>& state) {
  state.sorted = false;
  sort_when_drifted(state);
  clock_.time(Stage::kAvoidVoid, [&] {
    resample::Resampler resampler = model_.resampler;
    resampler.threads = threads_;
    std::vector<std::uint32_t> around;
    resampler.allowed = [&](const Vec3& x) {
      obstacles_.find_near(x, 0, around);
      return around.empty() && model_.walls.inside(x);
    };
    const resample::Outcome done =
        resample::avoid_void(state.sets, grid_, resampler, {model_.scene.seed, state.step}, state.next_id);
    state.resampled.inserted += done.inserted;
    state.resampled.merged += done.merged;
    state.resampled.momentum_change += done.momentum_change.norm();
    state.sorted = done.inserted == 0 && done.merged == 0;
  });
}

template <class Real>
std::optional<std::uint64_t> Stepper<Real>::interior_voids(const State<Real>& state) {
  obstacles_.place(state.time, 0);
  return count_interior_voids(state.sets, model_.bounds, obstacles_, model_.scene.domain.box.min,
                              model_.scene.spacing);
}

template class Stepper<float>;
template class Stepper<double>;

}  // namespace lather::mpm
