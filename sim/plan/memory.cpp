#include "sim/plan/memory.h"

#include <algorithm>
#include <cmath>

#include "sim/plan/void_search.h"

namespace lather {
namespace {

double real_bytes(const Scene& s) {
  return s.numerics.precision == Precision::kFloat ? 4 : 8;
}

/// Bytes of all points in full tiles.
double particle_bytes(const Plan& plan) {
  double bytes = 0;
  for (const PlannedMaterial& m : plan.materials) bytes += static_cast<double>(m.points) * m.bytes_per_point;
  return bytes;
}

double domain_cells(const Scene& s) {
  double cells = 1;
  for (int a = 0; a < s.dimension; ++a) cells *= s.domain.box.extent()[a] / s.spacing;
  return cells;
}

/// Points, block buffers and the grid. `points` counts those that resampling adds, too.
double mpm_bytes(const Plan& plan, double points) {
  const Scene& s = plan.scene;
  const double real = real_bytes(s);
  const double particles = particle_bytes(plan) * points / static_cast<double>(plan.points);
  const double points_per_block = std::pow(4, s.dimension) * s.points_per_cell;
  // Half as many blocks again as a full packing needs, and a shell of grid blocks around them.
  const double blocks = 1.5 * points / points_per_block + 27;
  const double quads = s.numerics.transfer == Transfer::kApic ? 1 : 2;
  const double buffers = blocks * quads * 4 * real * (std::pow(8, s.dimension) + 4);
  const double vectors = s.numerics.integration == Integration::kSemiImplicit ? 4 : 0;  // the solver's
  const double grid = 3 * blocks * (quads + vectors) * 4 * real * std::pow(4, s.dimension);
  const double resampling = s.numerics.resampling ? 60 * points : 0;  // the points' bins, distances
  const double voids = std::min(domain_cells(s), kMostSearchedCells);
  return 2.2 * particles + buffers + grid + resampling + voids;
}

/// Terms of the basis: 1; x y z; their squares and products.
double basis_terms(Basis basis, int dimension) {
  if (basis == Basis::kConstant) return 1;
  return basis == Basis::kLinear ? 1 + dimension : (1 + dimension) * (2 + dimension) / 2;
}

/// Points and the rows that the MLSRK solver keeps of each.
double mlsrk_bytes(const Plan& plan) {
  const Scene& s = plan.scene;
  const double d = s.dimension;
  // A block of 4 cells an axis holds 4 full tiles in 3D and one in 2D where it is full; at surfaces, and
  // where points have moved, lanes are empty: half as many slots again.
  const double slots = 1.5 * static_cast<double>(plan.points);
  const double terms = basis_terms(s.numerics.mlsrk.basis, s.dimension);
  const double shape = terms * (1 + d);                        // b and its gradient
  const double place = 4;                                      // and volume
  const double stress = 8;                                     // with mass
  const double velocity = 4 + d * d + d;                       // with mass, its gradient, the smoothed one
  const double reals = place + shape + stress + velocity + 2;  // crowding and pivots beside them
  const double indices = 8 + 4;                                // from slots to points and back
  const double blocks = 40 * 32;  // a block's neighbours and extents, over its 16 … 64 points
  return 3 * particle_bytes(plan) + slots * (reals * real_bytes(s) + indices) +
         blocks * slots / std::pow(4, d) + std::min(domain_cells(s), kMostSearchedCells);
}

}  // namespace

std::uint64_t expected_memory(const Plan& plan) {
  const Scene& s = plan.scene;
  // Resampling adds points: the paper's scenes grow by up to a third.
  const double points = (s.numerics.resampling ? 1.5 : 1.0) * static_cast<double>(plan.points);
  const double solver = s.solver == Solver::kMlsrk ? mlsrk_bytes(plan) : mpm_bytes(plan, points);
  const double frame = 3.0 * points * (29 + 4 * static_cast<double>(plan.scalars.size()));
  // The skin's grid and mesh by its area, at the most that of loose points; files are made one at a time.
  const double skin = s.wants_skin() ? 600.0 * points : 0;
  const double files = s.output.particles.empty() ? 0 : 200.0 * points;
  const double samples =
      static_cast<double>(s.output.width) * s.output.height * s.output.supersampling * s.output.supersampling;
  return static_cast<std::uint64_t>(solver + frame + skin + files + samples * 60 + 128e6);
}

}  // namespace lather
