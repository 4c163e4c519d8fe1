#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/material/law_constants.h"
#include "sim/material/tearing_constants.h"
#include "sim/plan/tile_layout.h"

/// The border between the solver and its kernels, which are compiled once per instruction set: plain structs
/// and pointers, no Eigen type, no standard container. A kernel works on one block on one thread.
///
/// Grid: blocks of 4^dim nodes; a node is a quad of four reals, (mass, x, y, z), rows run along the last
/// axis, so that a row of a block is 16 consecutive reals. A block's points reach nodes from two below its
/// first to two beyond its last: the block buffer, 8^dim nodes.
namespace lather::mpm {

inline constexpr int kBlockWidth = 4;   ///< nodes per axis of a grid block
inline constexpr int kBufferWidth = 8;  ///< nodes per axis of a block buffer
inline constexpr int kBufferBelow = 2;  ///< of them below the block's first node
inline constexpr int kQuad = 4;         ///< reals per node
inline constexpr int kMaxMaterials = 64;

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}
constexpr int block_nodes(int dim) {
  return power(kBlockWidth, dim);
}
constexpr int block_reals(int dim) {
  return kQuad * block_nodes(dim);
}
/// One row more than the nodes need: quadratic rows are read four wide with a zero weight at the end.
constexpr int buffer_reals(int dim) {
  return kQuad * (power(kBufferWidth, dim) + kBlockWidth);
}
constexpr int neighbours(int dim) {
  return power(3, dim);
}

/// A node with less mass, kg, would lose the digits of p/m: it takes no part.
template <class Real>
inline constexpr Real kLeastMass = sizeof(Real) == 4 ? Real(1e-34) : Real(1e-290);

template <class Real>
struct MaterialConstants;

/// A tile of one material's points.
template <class Real>
struct PointTile {
  std::byte* bytes;
  const TileLayout* layout;
  const MaterialConstants<Real>* material;
};

/// A law on tiles of its material's points; called once a tile, which costs nothing beside its transfer.
template <class Real>
struct LawKernels {
  /// Kirchhoff stress, Pa: [6][16] of xx yy zz xy xz yz. Returns the largest factor by which moduli are
  /// hardened, at least 1.
  Real (*stress)(const PointTile<Real>&, Real* tau);
  /// Deformation and return mapping over a step; `increment` = dt grad v, [9][16], row by row; in 2D
  /// with what weak points are given across the plane.
  void (*deform)(const PointTile<Real>&, Real dt, const Real* increment);
};

/// One material's constants in the run's precision, and the kernels of its law.
template <class Real>
struct MaterialConstants {
  Real mass;    ///< of each point, kg
  Real volume;  ///< of each point at rest, m^3
  /// J - 1 of a point that fills its cell alone: liquids', and J_p - 1 of grains' and snow's, get no larger.
  Real most_opened;
  LawConstants<Real> law;
  TearingConstants<Real> tearing;
  LawKernels<Real> kernels;
};

/// One material's points in one block.
template <class Real>
struct BlockPoints {
  std::byte* tiles;
  std::int32_t count;  ///< points; tiles = ceil(count / 16)
  const TileLayout* layout;
  const MaterialConstants<Real>* material;
};

/// What all blocks share in a step.
template <class Real>
struct StepConstants {
  Real dt;          ///< s
  Real cell;        ///< h, m
  Real gravity[3];  ///< m/s^2
  Real flip;        ///< alpha of this step: share of FLIP against PIC
  Real phase;       ///< of rounding positions, in [0, 1): see advance()
};

/// Weights of what stiffness() adds up, dimensionless but the last; see sim/mpm/stiffness.h.
template <class Real>
struct StiffnessTerms {
  Real stress;     ///< of the stress at hand
  Real material;   ///< of the change of stress that deformation brings; never negative as an energy
  Real geometric;  ///< of the change of force that turning and stretching under stress bring
  Real diffusion;  ///< of velocity, m^2/s
};

/// A block's place: index of its first node per axis.
struct BlockPlace {
  std::int32_t first_node[3];
};

/// What advance() saw of a block.
struct BlockExtremes {
  double largest_cells = 0;  ///< largest |v| dt / h along an axis
  double speed_squared = 0;  ///< largest, (m/s)^2
  bool finite = true;        ///< of every velocity and all that the law keeps
  bool collapsed = false;    ///< some J <= 0
};

/// Where the parts of a step spend time; kernels add nothing here, their caller does.
template <class Real>
struct Kernels {
  /// [2. detect tearing regions] Writes kPlasticity of a material that tears.
  void (*detect_tearing)(const BlockPoints<Real>&);

  /// [1. rasterize, 3. grid forces, 4. limit forces] Adds the points of one material to the block buffers
  /// `momentum` (m, p) and, with FLIP, `force` (0, f); with APIC the force's impulse dt f goes into
  /// `momentum` and `force` is not touched. Returns the largest factor by which moduli are hardened.
  Real (*scatter)(const BlockPoints<Real>&, const BlockPlace&, const StepConstants<Real>&, Real* momentum,
                  Real* force);

  /// Sums the block buffers around a grid block in a fixed order. `buffers[n]` is the buffer of the block at
  /// offset n (last axis fastest, each -1 … 1), null where there is none.
  void (*reduce)(const Real* const* buffers, Real* node);

  /// [5. update grid velocities] node: (m, p) -> (m, v*); increment: (0, f) -> (0, v* - v) with FLIP, else
  /// not touched.
  void (*update_grid)(const StepConstants<Real>&, Real* node, Real* increment);

  /// Copies the nodes around a block from the grid blocks `blocks[n]` into a buffer.
  void (*collect)(const Real* const* blocks, Real* buffer);

  /// [7. deformation, 8. limit deformation, 9. velocities, 10. plastic flow] of one material's points from
  /// the buffers of (m, v*), (0, v* - v).
  void (*gather)(const BlockPoints<Real>&, const BlockPlace&, const StepConstants<Real>&,
                 const Real* velocity, const Real* increment);

  /// [11. plastic recovery] of a material that tears; exponent = (exp(-t/eta_p) - 1)/2.
  void (*recover)(const BlockPoints<Real>&, Real exponent);

  /// [14. positions] x += dt v, and a check of the state.
  BlockExtremes (*advance)(const BlockPoints<Real>&, const StepConstants<Real>&);

  /// [semi-implicit step] Adds to the block buffer `impulse` (0, p) the momentum that the points' internal
  /// forces give over dt while the grid moves with `velocity`, a buffer of (any, v): a linear function of it,
  /// plus a constant.
  void (*stiffness)(const BlockPoints<Real>&, const BlockPlace&, const StepConstants<Real>&,
                    const StiffnessTerms<Real>&, const Real* velocity, Real* impulse);
};

/// Eigenvalues and tearing at one point, for tests. State as in PointKernels; tensors row by row, symmetric
/// ones xx yy zz xy xz yz; `G` = F - I.
template <class Real>
struct TearingKernels {
  /// vector: 3 rows, the k-th belongs to value[k].
  void (*eigenpairs)(const Real* a, Real* value, Real* vector);
  Real (*largest_eigenvalue)(const Real* a);
  /// R - I of I + A.
  void (*polar_rotation)(const Real* A, Real* R_minus_identity);
  void (*deformed)(const Real* G, const Real* A, Real* deformed);
  Real (*plasticity)(const Real* state, const Real* G);
  void (*limited_stress)(const Real* tau, Real* limited);
  void (*limited_increment)(const Real* state, const Real* A, Real* limited);
  void (*recovered)(const Real* state, const Real* G, Real exponent, Real* recovered);
};

/// The law of Herschel-Bulkley at single points, for tests and the rheometer.
template <class Real>
struct PointKernels {
  /// s - sqrt(2/3) sigma_Y after the return mapping, for n points with excess_pre = s_pre - sqrt(2/3)
  /// sigma_Y.
  void (*plastic_excess)(const HerschelBulkleyConstants<Real>&, const Real* excess_pre, const Real* two_mu_dt,
                         int n, Real* excess);
  /// The same by the scalar twin of the wide kernel.
  void (*plastic_excess_scalar)(const HerschelBulkleyConstants<Real>&, const Real* excess_pre,
                                const Real* two_mu_dt, int n, Real* excess);
  /// One step of the law at one point: `state` = (J - 1, B xx yy zz xy xz yz), `A` = dt grad v row by row.
  /// Returns the equivalent plastic strain of the step.
  Real (*law_step)(const HerschelBulkleyConstants<Real>&, const Real* A, Real dt, Real* state);
  /// The same with 16 lanes, all alike; lane `lane` is returned.
  Real (*law_step_wide)(const HerschelBulkleyConstants<Real>&, const Real* A, Real dt, Real* state, int lane);
  /// Kirchhoff stress xx yy zz xy xz yz of `state`, Pa.
  void (*stress)(const HerschelBulkleyConstants<Real>&, const Real* state, Real* tau);
  /// Kernel weights at fraction f of a cell: 4 weights and 4 derivatives (per cell), cubic or quadratic.
  /// Returns the first node's offset from the cell.
  int (*weights)(bool cubic, Real fraction, Real* weight, Real* derivative);
  TearingKernels<Real> tearing;       ///< scalar
  TearingKernels<Real> tearing_wide;  ///< the point in one of 16 lanes, the others at rest
};

/// Points by rows, each a run of them: (x, y, z) one after the other.
struct PointRows {
  const float* x;
  const std::uint32_t (*row)[2];  ///< first point, and the one after the last
  int rows;
};

/// Lowers `squared[k]`, k < count, to the squared distance of place k from the nearest of the points, 16
/// places at a time: no further than to below `enough`, where the rest of the points is not looked at.
/// `place` is [3][count]; count is a multiple of 16.
using NearestKernel = void (*)(const float* place, int count, const PointRows& points, float enough,
                               float* squared);

/// Kernels of one level; picked by dimension (2, 3), kernel order and transfer.
template <class Real>
struct KernelTable {
  Kernels<Real> step[2][2][2];      ///< [dimension - 2][cubic][apic]
  LawKernels<Real> laws[2][kLaws];  ///< [dimension - 2][index of the law]
  PointKernels<Real> point;
  NearestKernel nearest;
};

}  // namespace lather::mpm
