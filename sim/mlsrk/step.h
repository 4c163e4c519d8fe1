#pragma once

#include <vector>

#include "sim/collide/obstacles.h"
#include "sim/frame_loop.h"
#include "sim/mlsrk/cloud.h"
#include "sim/mlsrk/grips.h"
#include "sim/mlsrk/levels.h"
#include "sim/particles/particle_set.h"
#include "sim/report/report.h"

namespace lather::mlsrk {

/// What never changes during a run: the scene as the step needs it, in the run's precision.
template <class Real>
struct Model {
  explicit Model(const Plan& plan);
  Model(const Model&) = delete;  // constants of materials point into by_concentration
  Model& operator=(const Model&) = delete;

  Scene scene;
  Kernels<Real> kernels;
  TileExtremes (*positions)(const SetTile<Real>&, const MoveStep<Real>&, const Real*, const Real*);
  std::vector<MaterialConstants<Real>> materials;
  std::vector<LawKernels<Real>> laws;  ///< one a material
  std::vector<double> wave_shares;     ///< of each material's squared wave speed in that of the step's bound
  PhaseKernels<Real> phases;
  std::vector<std::vector<LawConstants<Real>>>
      by_concentration;  ///< one a material; empty where none changes
  ShapeConstants<Real> shape;
  Real lattice_crowding;  ///< sum_j Phi of a point inside a full lattice: V/V0 = 1 [MLSRK eq. 19]
  bool corrects = false;  ///< some volume comes from its neighbours
  /// m: how far from solids points stop. Half a spacing where `corrects`, so that a lattice that fills a
  /// container lies as it will rest there; else 0.
  double stand_off = 0;
  bool swells = false;  ///< some volume at rest changes with the concentration
  CellBounds bounds;
  Walls walls;
};

/// What a checkpoint saves.
template <class Real>
struct State {
  std::vector<ParticleSet<Real>> sets;  ///< one a material
  std::uint64_t step = 0;               ///< steps done
  double time = 0;                      ///< s
  double drift = 0;                     ///< spacings, most that any point can have moved since the last sort
  bool sorted = false;
  // Of the last step, for the length of the next one:
  double max_speed = 0;         ///< m/s
  double max_acceleration = 0;  ///< m/s^2, by forces
  double stiffest = 1;  ///< largest factor by which hardening raises squared wave speeds over the bound's
  // Since the start:
  std::uint64_t regularized = 0;  ///< moment matrices that needed more than the constants' r
  std::uint64_t light = 0;        ///< lumped masses below a tenth of the point's own
  std::vector<Departures> left;   ///< one a material: left an open domain
};

/// One step of the method [MLSRK Algorithm 1].
template <class Real>
class Stepper {
 public:
  Stepper(const Model<Real>& model, int threads);

  /// Advances `state` by dt (s). The result says whether the state is still sound; the caller decides.
  StepExtremes step(State<Real>& state, double dt);

  /// Sorts the points and makes their tiles anew if some may have left the reach that the tiles allow for;
  /// counts those that left an open domain.
  void sort_when_drifted(State<Real>& state);

  /// Sums with the lumped masses of the present places, as the next step will have them.
  [[nodiscard]] LumpedMeasure measure_lumped(State<Real>& state);

  /// Drops the tiles, so that the next step makes them anew; after a restore.
  void forget_tiles() { cloud_.clear(); }

  [[nodiscard]] const StageClock& clock() const { return clock_; }
  [[nodiscard]] const Grips& grips() const { return grips_; }

 private:
  /// Memory of one thread.
  struct Scratch {
    typename Cloud<Real>::Scratch nearby;
    std::vector<std::uint32_t> near;
  };
  /// One of the sets' tiles.
  struct TileOfSet {
    std::uint32_t set;
    std::uint32_t tile;
  };

  void find_neighbours(State<Real>& state);
  /// Returns how many moment matrices needed more than the constants' r.
  std::uint64_t compute_shape_functions();
  void weigh_crowding(State<Real>& state);
  void fill_solids();
  void compute_stress(State<Real>& state);
  bool update_velocities(State<Real>& state, double dt);
  double accelerate(std::size_t tile, const MomentumStep<Real>& step, Scratch& scratch, std::uint64_t& light);
  void resolve_collisions(std::size_t tile, double dt, Scratch& scratch);
  bool drive_points(std::size_t tile, double dt);
  void compute_gradients();
  void diffuse(State<Real>& state, double dt);
  void show_concentrations(State<Real>& state);
  [[nodiscard]] double inertia(std::uint32_t set, std::uint32_t slot) const;
  StepExtremes update_points(State<Real>& state, double dt);

  [[nodiscard]] SetTile<Real> set_tile(State<Real>& state, const TileOfSet& at) const;
  /// Calls work(tile) for the sets' tiles, in parallel.
  template <class Work>
  void for_set_tiles(Stage stage, const Work& work);
  /// Calls kernel(tile, its surroundings) for the cloud's tiles, in parallel.
  template <class Kernel>
  void on_tiles(Stage stage, const Kernel& kernel);
  /// Calls visit(lane, slot) for the points of a set's tile.
  template <class Visit>
  void for_points(const State<Real>& state, const TileOfSet& at, const Visit& visit) const;
  /// Does a grip prescribe the velocity of the slot's point in this step?
  [[nodiscard]] bool driven(std::size_t slot) const { return !grip_.empty() && grips_.drives(grip_[slot]); }
  void note_grips(const State<Real>& state);
  /// Component of a slot's velocity, m/s, or, the fourth, its mass, kg.
  [[nodiscard]] Real& velocity(std::size_t slot, int row) {
    return velocity_[(slot / kTile * kVelocityRows + static_cast<std::size_t>(row)) * kTile + slot % kTile];
  }
  /// What a slot's point shows its neighbours, see PhaseRows.
  [[nodiscard]] Real& shown(std::size_t slot, int row) {
    return phase_[(slot / kTile * PhaseRows::kCount + static_cast<std::size_t>(row)) * kTile + slot % kTile];
  }
  [[nodiscard]] Scratch& scratch() { return scratch_[static_cast<std::size_t>(thread_index())]; }

  const Model<Real>& model_;
  int threads_;
  Obstacles obstacles_;
  Grips grips_;
  Cloud<Real> cloud_;
  StageClock clock_;
  std::vector<Scratch> scratch_;
  std::vector<TileOfSet> set_tiles_;
  // See kernels.h.
  std::vector<Real> velocity_;
  std::vector<Real> shape_;
  std::vector<Real> stress_;
  std::vector<Real> crowding_;       // one a slot
  std::vector<std::uint32_t> grip_;  // Field::kGrip, one a slot; empty without grips
  std::vector<Real> gradient_;       // [dim dim][16] a tile
  std::vector<Real> smooth_;         // [dim][16] a tile
  // Of phases only:
  std::vector<Real> phase_;
  std::vector<Real> flux_;
  std::vector<Real> potential_;      // one a slot; volumes at rest, and what fluxes give back, too
  std::vector<Real> gain_;           // one a slot
  std::vector<Real> lumped_volume_;  // one a slot, over a^dim
};

}  // namespace lather::mlsrk
