#pragma once

#include <memory>
#include <vector>

#include "sim/collide/obstacles.h"
#include "sim/frame_loop.h"
#include "sim/mpm/block_grid.h"
#include "sim/mpm/levels.h"
#include "sim/mpm/probe_tally.h"
#include "sim/mpm/resample/avoid_void.h"
#include "sim/mpm/resample/subgrid_removal.h"
#include "sim/particles/particle_set.h"
#include "sim/report/stage_clock.h"

namespace lather::mpm {

/// What never changes during a run: the scene as the step needs it, in the run's precision.
template <class Real>
struct Model {
  explicit Model(const Plan& plan);

  Scene scene;
  Kernels<Real> kernels;
  PointKernels<Real> point;
  std::vector<MaterialConstants<Real>> materials;
  CellBounds bounds;
  Walls walls;
  resample::Resampler resampler;    ///< without obstacles: the stepper has them
  resample::SubgridSearch removal;  ///< of scenes that ask for it
  double drift_margin;              ///< cells that a point may move between two sorts
};

/// What resampling did since the start.
struct ResampleTotals {
  std::uint64_t inserted = 0;
  std::uint64_t merged = 0;    ///< points that went into others
  double momentum_change = 0;  ///< sum over all resamplings of |change of momentum|, kg m/s
};

/// What subgrid removal took away since the start.
struct RemovalTotals {
  std::uint64_t points = 0;
  double mass = 0;  ///< kg
};

/// What an emitter has done so far; plain data, saved as it stands.
struct EmitterState {
  std::uint64_t releases = 0;  ///< copies, or layers of a stream
  std::uint64_t points = 0;    ///< emitted
  std::uint64_t delayed = 0;   ///< releases that found their place occupied when they were due
  double waited = 0;           ///< s, of all releases
  double last = 0;             ///< s: a stream's last layer came then, moved on by what it has waited
  double travelled = 0;        ///< s, in which a stream's lattice has moved
  bool waiting = false;        ///< a release is due now, and its place is occupied
};

/// What a checkpoint saves.
template <class Real>
struct State {
  std::vector<ParticleSet<Real>> sets;  ///< one a material
  std::uint64_t step = 0;               ///< steps done
  double time = 0;                      ///< s
  double drift = 0;                     ///< cells, most that any point can have moved since the last sort
  double max_speed = 0;                 ///< m/s, of any point
  double stiffest = 1;                  ///< largest factor by which moduli are hardened, in the last step
  bool sorted = false;
  std::uint32_t next_id = 0;  ///< of the next new point; ids are never used again
  ResampleTotals resampled;
  RemovalTotals removed;
  std::vector<double> since_recovery;         ///< s, one a material: time whose recovery is still to come
  std::vector<EmitterState> emitters;         ///< one an emitter of the scene
  std::vector<std::uint64_t> points_emitted;  ///< one a material
  std::vector<Departures> left;               ///< one a material: left an open domain
  std::vector<ProbeState> probes;             ///< one a probe of the scene
};

/// One material's points in range `range` of its set.
template <class Real>
[[nodiscard]] BlockPoints<Real> block_points(ParticleSet<Real>& set, std::int32_t range,
                                             const MaterialConstants<Real>& material) {
  const BlockRange& r = set.ranges()[static_cast<std::size_t>(range)];
  return {set.tile(static_cast<std::size_t>(r.first_tile)), r.count, &set.layout(), &material};
}

/// How a semi-implicit step's velocities were solved for.
struct SolveFigures {
  int iterations = 0;
  bool converged = true;  ///< to the tolerance
  bool convex = false;    ///< went on without the part of the stiffness that may be negative
};

/// What a step saw.
struct StepResult {
  StepExtremes extremes;
  SolveFigures solve;
};

template <class Real>
class VelocitySolver;

/// One step of the Material Point Method.
template <class Real>
class Stepper {
 public:
  Stepper(const Model<Real>& model, int threads);
  ~Stepper();

  /// Lets in what the scene's emitters release at the state's time; call before each step's length is chosen.
  void emit(State<Real>& state);

  /// Advances `state` by dt (s). The result says whether the state is still sound; the caller decides.
  StepResult step(State<Real>& state, double dt);

  /// Sorts points and rebuilds the grid if points may have left their blocks' buffers; counts those that left
  /// an open domain.
  void sort_when_drifted(State<Real>& state);

  /// Drops the grid, so that the next step makes it anew; after a restore.
  void forget_grid() {
    grid_ = BlockGrid<Real>(model_.scene.dimension, model_.scene.numerics.transfer == Transfer::kApic);
  }

  /// Sum of w V_p over h^dim at every node of grid block g (block_nodes values), from the state as it stands:
  /// 1 inside undisturbed material. Call after sort_when_drifted().
  void rasterize_volume_fraction(State<Real>& state);
  [[nodiscard]] const BlockGrid<Real>& grid() const { return grid_; }

  /// Brings kPlasticity of all points up to date. Call after sort_when_drifted().
  void detect_tearing(State<Real>& state);
  [[nodiscard]] double volume_fraction(std::size_t block, int node) const;

  /// Empty cells inside the material, see count_interior_voids(); obstacles as they stand at the state's
  /// time.
  [[nodiscard]] std::optional<std::uint64_t> interior_voids(const State<Real>& state);

  [[nodiscard]] const StageClock& clock() const { return clock_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] StepConstants<Real> constants(const State<Real>& state, double dt) const;
  /// Returns the largest factor by which moduli are hardened.
  double rasterize(State<Real>& state, const StepConstants<Real>& step,
                   const std::vector<MaterialConstants<Real>>& materials);
  void update_grid(const StepConstants<Real>& step);
  void grid_velocities(std::size_t block, const StepConstants<Real>& step);
  SolveFigures solve_grid(State<Real>& state, const StepConstants<Real>& step);
  void resolve_grid_collisions(std::size_t block, std::vector<std::uint32_t>& near);
  StepExtremes update_particles(State<Real>& state, const StepConstants<Real>& step);
  void plan_recovery(State<Real>& state, double dt);
  void resolve_particle_collisions(std::size_t set, std::size_t block, ParticleSet<Real>& points,
                                   const BlockRange& range, double dt, std::vector<std::uint32_t>& near);
  void remove_subgrid(State<Real>& state);
  void avoid_void(State<Real>& state);

  const Model<Real>& model_;
  int threads_;
  Obstacles obstacles_;
  ProbeTally tally_;
  BlockGrid<Real> grid_;
  std::unique_ptr<VelocitySolver<Real>> solver_;  // null in explicit scenes
  StageClock clock_;
  std::vector<Real> recovery_exponent_;           // this step's, one a material; 0: none
  std::vector<std::vector<Real>> scratch_;        // per thread: two block buffers
  std::vector<std::vector<std::uint32_t>> near_;  // per thread
};

}  // namespace lather::mpm
