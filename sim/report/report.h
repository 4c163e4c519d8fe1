#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/math/vec.h"

namespace lather {

struct StageTime {
  std::string name;           ///< as in the plan
  double seconds = 0;         ///< summed over threads
  double serial_seconds = 0;  ///< of them, on one thread while all others waited
};

/// What an emitter has done.
struct EmitterReport {
  std::string name;
  std::uint64_t releases = 0;  ///< copies, or layers of a stream
  std::uint64_t points = 0;
  std::uint64_t delayed = 0;  ///< releases that found their place occupied when they were due
  double waited = 0;          ///< s, of all of them
  bool waiting = false;       ///< a release is due and still waits
};

/// The samples of one probe.
struct ProbeSeries {
  struct Column {
    std::string quantity;
    std::string unit;
  };
  std::string name;
  std::string type;  ///< as in the scene
  std::vector<Column> columns;
  std::vector<double> times;   ///< s
  std::vector<double> values;  ///< row by row, a row a time
};

/// Of the points that carry a concentration.
struct PhaseMeasure {
  double component_mass = 0;  ///< sum of m c, kg
  double least = 0;           ///< c, dimensionless
  double largest = 0;
  double rest_volume = 0;  ///< sum of m over the density at rest at c, m^3; m^2 in 2D
};

/// Sums with the lumped masses of the MLSRK solver, sum_j N_i(x_j) m_j. [MLSRK eq. 11]
struct LumpedMeasure {
  double mass = 0;                      ///< kg
  std::array<double, 3> momentum = {};  ///< kg m/s: what one step's forces keep, until masses change
  double kinetic_energy = 0;            ///< J
};

/// What one frame measured of the state, sums taken in a fixed order in double precision.
struct FrameMeasure {
  int frame = 0;
  double time = 0;  ///< s
  std::uint64_t step = 0;
  std::uint64_t points = 0;
  std::uint64_t points_emitted = 0;  ///< since the start, by emitters
  std::uint64_t points_left = 0;     ///< since the start, out of an open domain
  double mass_emitted = 0;           ///< kg
  double mass_left = 0;              ///< kg
  std::uint64_t fingerprint =
      0;            ///< of all bits of all points: equal for any number of threads and after a resume
  double mass = 0;  ///< kg
  Vec3 momentum = Vec3::Zero();          ///< kg m/s
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin, kg m^2/s, with the affine part of APIC
  Vec3 center_of_mass = Vec3::Zero();    ///< m
  Vec3 lowest = Vec3::Zero();            ///< smallest coordinates of any point, m
  Vec3 highest = Vec3::Zero();
  double kinetic_energy = 0;         ///< J
  double elastic_volume_energy = 0;  ///< J
  double elastic_shear_energy = 0;   ///< J
  double gravity_energy = 0;         ///< J, zero at the origin
  double max_speed = 0;              ///< m/s
  double min_volume_ratio = 0;       ///< smallest J, dimensionless
  double max_volume_ratio = 0;
  double weak_fraction = 0;          ///< of all points: torn, plasticity above the tear_threshold
  std::int64_t interior_voids = -1;  ///< empty grid cells inside the material; -1: too large to be searched
  // Resampling, since the start.
  std::uint64_t points_inserted = 0;
  std::uint64_t points_merged = 0;   ///< into others
  double resampling_momentum = 0;    ///< sum of |change of momentum| over all resamplings, kg m/s
  std::uint64_t points_removed = 0;  ///< by subgrid removal, since the start
  double mass_removed = 0;           ///< with them, kg
  // Grid density m_i/h^3 at interior nodes (every cell under the kernel's support holds a point), over the
  // initial one.
  std::uint64_t interior_nodes = 0;
  double density_mean = 0;
  double density_min = 0;
  double density_max = 0;
  double density_within_5_percent = 0;  ///< fraction of interior nodes
  std::optional<double>
      skin_volume;  ///< enclosed by the skins of all materials, m^3; where they are asked for
  std::optional<PhaseMeasure> phases;   ///< where materials carry a concentration
  std::optional<LumpedMeasure> lumped;  ///< of the MLSRK solver
  // Connected pieces of the material; see sim/report/pieces.h.
  std::uint64_t pieces = 0;        ///< with at least 1 % of the points each
  double largest_piece_share = 0;  ///< of the points
  double second_piece_share = 0;   ///< of the points, 0 where there is one piece
};

/// The solver of a semi-implicit run.
struct SolverTotals {
  std::uint64_t solves = 0;
  std::uint64_t iterations = 0;   ///< of all solves
  int most_iterations = 0;        ///< of one solve
  std::uint64_t unconverged = 0;  ///< solves that ended short of the tolerance
  std::uint64_t convex = 0;       ///< solves that went on without the stiffness that may be negative
};

/// What was promised of a run with a budget, beside which its wall time stands.
struct BudgetReport {
  double seconds = 0;  ///< asked for; 0: an error was
  double error = 0;    ///< asked for; 0: seconds were
  std::string quality;
  double predicted_seconds = 0;  ///< wall clock
  double predicted_error = 0;    ///< largest of the quality on exact cases, dimensionless
  double actual_seconds = 0;     ///< wall clock, of steps, drawing and files together
};

/// What happened: measured, never planned.
struct Report {
  std::string state = "running";  ///< "running", "succeeded", "failed", "cancelled"
  std::string error;              ///< why it failed, in words that help
  std::string scene_name;
  std::string scene_hash;
  std::string version;
  std::string kernel_level;
  std::string render_backend;
  int threads = 0;
  std::uint64_t steps = 0;
  std::uint64_t point_steps = 0;
  double simulated_time = 0;  ///< s
  double wall_seconds = 0;    ///< in simulation steps
  double serial_seconds = 0;  ///< of them, outside of loops that all threads share; of this process only
  double render_seconds = 0;  ///< in drawing and encoding, beside the steps
  double point_steps_per_second = 0;
  double largest_cfl = 0;         ///< speed dt / spacing, dimensionless
  double smallest_time_step = 0;  ///< s
  double largest_time_step = 0;   ///< s
  SolverTotals solver;            ///< of an explicit run: all 0
  // Of the MLSRK solver, point by point and step by step:
  std::uint64_t regularized_moments =
      0;                           ///< moment matrices that needed more than the scene's regularization
  std::uint64_t light_masses = 0;  ///< lumped masses below a tenth of the point's own, which took its place
  std::vector<EmitterReport> emitters;
  std::vector<ProbeSeries> probes;
  std::vector<StageTime> stages;
  std::vector<FrameMeasure> frames;
  std::vector<std::string> warnings;
  std::optional<BudgetReport> budget;  ///< of a scene that has one
};

[[nodiscard]] std::string to_json(const Report& report);

/// All samples as CSV with the columns probe, quantity, unit, time (s), value.
[[nodiscard]] std::string probes_csv(const std::vector<ProbeSeries>& probes);

}  // namespace lather
