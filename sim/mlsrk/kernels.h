#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/material/law_constants.h"
#include "sim/plan/tile_layout.h"

/// The border between the solver and its kernels, which are compiled once per instruction set: plain structs
/// and pointers, no Eigen type, no standard container.
///
/// Points of all materials lie in a cloud (cloud.h), sorted by cell, in tiles of 16. A kernel works on one
/// tile of points and what is within reach of it (nearby.h), in a fixed order, so that nothing depends on the
/// number of threads. Lengths are divided by the kernel's scale a, volumes by a^dim.
///
/// "MLSRK": "A Moving Least Square Reproducing Kernel Particle Method for Unified Multiphase Continuum
/// Simulation". Basis h of N polynomials, kernel Phi, xi = (x_j - x_i)/a:
///
///   M_i = sum_j h(xi) h(xi)^T Phi(xi) V_j + R,  b_i = M_i^-1 h(0)      [MLSRK eq. 8, 32]
///   N_j(x_i) = b_i . h(xi) Phi(xi) V_j                                 [MLSRK eq. 8]
///   a d_B N_j(x_i) = (c_iB . h(xi) Phi(xi) - b_i . h(xi) d_B Phi(xi)) V_j  [MLSRK Appendix A]
namespace lather::mlsrk {

/// What all points share.
template <class Real>
struct ShapeConstants {
  Real regularization;           ///< r on all terms but the constant, dimensionless
  Real constant_regularization;  ///< r on the constant, dimensionless
  Real smallest_pivot;           ///< a moment matrix with a smaller one takes this as its r
};

/// Smallest and largest coordinates of a tile's points, from its block's corner.
template <class Real>
struct Extent {
  Real low[3];
  Real high[3];
};

/// A block whose points may be within reach of another's, and where it stands, periodic axes unwound.
template <class Real>
struct NearBlock {
  std::int32_t first_tile;
  std::int32_t tiles;
  Real shift[3];
};

/// Where the coordinates of empty lanes lie: out of reach of all points.
inline constexpr float kNowhere = 1e4F;

/// A tile's points, and all that may be within reach of them.
template <class Real>
struct Surroundings {
  std::uint32_t tile;
  std::int32_t count;           ///< the tile's points
  const Real* place;            ///< of the cloud: x y z from the block's corner, V; [4][16] a tile
  const Extent<Real>* extents;  ///< of the cloud, one a tile
  const NearBlock<Real>* blocks;
  std::int32_t block_count;
  Real* scratch;         ///< scratch_reals(points of the blocks)
  std::uint32_t* slots;  ///< likewise, one a point of the blocks and 16 more
};

/// Length of a row of scratch memory for `points`: with room for a lane that begins at the last one, and odd
/// in cache lines, so that rows do not lie at the same places of the cache.
constexpr std::size_t scratch_stride(std::size_t points) {
  return (((points + 15) / 16 + 1) | 1U) * 16;
}
/// Coordinates, volumes and up to three other values of all points near a tile; and of each of its points'
/// neighbours offsets, volumes and the kernel's slopes.
constexpr std::size_t scratch_reals(std::size_t points) {
  return (7 + 16 * 7) * scratch_stride(points);
}

/// Velocity (m/s) and mass (kg): [4][16] a tile.
inline constexpr int kVelocityRows = 4;
/// Rows of eight: V sigma, xx yy zz xy xz yz (Pa m^3), 0, mass (kg).
inline constexpr int kStressReals = 8;

/// A lumped mass below this share of the point's own one gives way to the latter.
inline constexpr double kLightest = 0.1;

/// What a step of momentum() needs.
template <class Real>
struct MomentumStep {
  Real dt;             ///< s
  Real gravity[3];     ///< m/s^2
  Real inverse_scale;  ///< 1/a, 1/m
  bool own_mass;       ///< forces are divided by a point's own mass, not by the lumped one
};

/// Kernels by dimension, basis and shape of Phi. Rows of so many reals: one a slot of the cloud.
template <class Real>
struct Kernels {
  std::int32_t shape_reals;  ///< of a shape row: b, then c of each axis

  /// [shape functions] Writes the tile's 16 shape rows, `crowding`, sum_j Phi, and `fallen`, 1 where a moment
  /// matrix had to be regularised beyond the constants; both [16].
  void (*shape_functions)(const ShapeConstants<Real>&, const Surroundings<Real>&, Real* shape, Real* crowding,
                          Real* fallen);

  /// [momentum] Adds a step's change to the tile's velocities [MLSRK eq. 11]; `shape` and `stress` are the
  /// rows of the whole cloud. `lumped_mass`, [16], kg: sum_j N_i(x_j) m_j; where light the own one counts.
  void (*momentum)(const MomentumStep<Real>&, const Surroundings<Real>&, const Real* shape,
                   const Real* stress, Real* velocity, Real* lumped_mass);

  /// [velocity gradients] `gradient`: [dim dim][16], row by row, 1/s [MLSRK eq. 18]; `smooth`: [dim][16],
  /// u^h(x_i) - u_i, m/s [MLSRK eq. 12]; `own_shape` are the tile's shape rows, `velocity` is that of the
  /// whole cloud.
  void (*gradients)(const ShapeConstants<Real>&, Real inverse_scale, const Surroundings<Real>&,
                    const Real* own_shape, const Real* velocity, Real* gradient, Real* smooth);
};

inline constexpr int kConcentrationSteps = 256;  ///< of a table over concentrations

/// One material's constants in the run's precision.
template <class Real>
struct MaterialConstants {
  Real volume;     ///< of each point at rest at t = 0, m^dim
  Real mass;       ///< of each point, kg
  bool corrected;  ///< volumes from neighbours, not from F [MLSRK eq. 19]
  LawConstants<Real> law;
  /// kConcentrationSteps + 1 of them, from c = 0 to 1; null: `law` is that of all points.
  const LawConstants<Real>* by_concentration;
};

/// A tile of one material's set.
template <class Real>
struct SetTile {
  std::byte* bytes;
  const TileLayout* layout;
  const MaterialConstants<Real>* material;
};

/// What points with a concentration show their neighbours: [3][16] a tile.
struct PhaseRows {
  static constexpr int kValue = 0;     ///< c, or the potential mu_c, dimensionless
  static constexpr int kMember = 1;    ///< 1; 0 of points without a concentration
  static constexpr int kMobility = 2;  ///< what grad mu_c is multiplied with: m L~ (kg m^2/s), or V L~
  static constexpr int kCount = 3;
};

/// What the phase kernels need of the scene.
template <class Real>
struct PhaseStep {
  Real inverse_scale;            ///< 1/a, 1/m
  Real squared_interface_width;  ///< epsilon^2, m^2
  bool double_well;              ///< H = c^2 (1 - c)^2 in place of (c - 1/2)^2
};

/// Concentrations by dimension, basis and shape of Phi. [phases]
template <class Real>
struct PhaseKernels {
  std::int32_t flux_reals;  ///< of a flux row

  /// [shape functions] `crowding`, [16], where points differ in their volumes at rest: sum_j Phi v_j, with
  /// `rest`, v_j, one a slot, over the volume at t = 0.
  void (*crowding)(const Surroundings<Real>&, const Real* rest, Real* crowding);

  /// `potential`, [16]: mu_c of the tile's points [MLSRK eq. 16]; `rows`, of the whole cloud, hold
  /// concentrations.
  void (*potentials)(const PhaseStep<Real>&, const Surroundings<Real>&, const Real* own_shape,
                     const Real* rows, Real* potential);
  /// The tile's 16 flux rows and `own`, [16]: what the point's own flux gives back to it; `rows` hold
  /// potentials.
  void (*fluxes)(const PhaseStep<Real>&, const Surroundings<Real>&, const Real* own_shape, const Real* rows,
                 Real* flux, Real* own);
  /// `gain`, [16]: -sum_j grad N_i(x_j) . q_j, and `volume`, [16]: sum_j N_i(x_j) V_j over a^dim. `flux` are
  /// the rows of the whole cloud.
  void (*gains)(const PhaseStep<Real>&, const Surroundings<Real>&, const Real* flux, Real* gain,
                Real* volume);
};

/// A law on tiles of its material's points.
template <class Real>
struct LawKernels {
  /// [neighbours] The points' volumes as their neighbours count them, m^dim, [16]. What bears no tension and
  /// takes its volume from its neighbours has empty space beside it where that is larger than at rest, and
  /// its own volume is the latter.
  void (*volumes)(const SetTile<Real>&, Real* volume);
  /// [shape functions] J_r, volumes at rest over those at t = 0, [16] [MLSRK eq. 30].
  void (*swelling)(const SetTile<Real>&, Real* ratio);
  /// [stress] Gives the points the volumes that their neighbours leave them, `change` = V/V_rest - 1, [16]
  /// [MLSRK eq. 19]; null for laws that never do.
  void (*correct)(const SetTile<Real>&, const Real* change);
  /// [stress] 16 stress rows. Returns the largest factor by which moduli are hardened.
  Real (*stress)(const SetTile<Real>&, Real* rows);
  /// [deformation] F' = (I + dt L) F [MLSRK eq. 17], return mapping; `gradient` is L, [dim dim][16].
  void (*deform)(const SetTile<Real>&, Real dt, const Real* gradient);
  /// [phases] c += `change`, [16]; F_e takes what the volume at rest gains or loses [MLSRK eq. 30, 31].
  void (*change_concentration)(const SetTile<Real>&, const double* change);
};

/// What positions() needs.
template <class Real>
struct MoveStep {
  Real dt;     ///< s
  Real cell;   ///< spacing, m
  Real blend;  ///< 1 - alpha_b of this step
  Real phase;  ///< of rounding positions, see move() in sim/particles/tile.h
};

/// What positions() saw of a tile.
struct TileExtremes {
  double largest_cells = 0;  ///< largest |u| dt over the spacing along an axis
  double speed_squared = 0;  ///< largest, (m/s)^2
  bool finite = true;
  bool collapsed = false;  ///< some J <= 0
};

/// [dimension - 2][basis][radial]; `scalar`: the same kernels one point at a time, for tests.
template <class Real>
struct KernelTable {
  LawKernels<Real> laws[2][2][kLaws];  ///< [dimension - 2][by concentration][index of the law]
  /// [positions] x += dt u, then u += blend (u^h - u) [MLSRK eq. 12]; `velocity`: [dim][16] of u,
  /// `smooth`: [dim][16] of u^h - u. [dimension - 2]
  TileExtremes (*positions[2])(const SetTile<Real>&, const MoveStep<Real>&, const Real* velocity,
                               const Real* smooth);
  Kernels<Real> wide[2][3][2];
  Kernels<Real> scalar[2][3][2];
  PhaseKernels<Real> phases[2][3][2];
  PhaseKernels<Real> scalar_phases[2][3][2];
};

}  // namespace lather::mlsrk
