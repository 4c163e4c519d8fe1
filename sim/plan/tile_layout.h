#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// How points lie in memory: tiles of 16 points, an array of structures of arrays. Plain data, shared with
/// the kernels.
///
/// A tile holds only the planned fields. Each field has one or more components, each 16 consecutive values. A
/// tile belongs to one grid block; the last tile of a block may have empty lanes, which hold harmless values.
namespace lather {

inline constexpr int kTile = 16;

enum class Field : int {
  kFraction,          ///< position within its cell, per axis, unsigned fixed point (FixedPoint<Real>)
  kVelocity,          ///< m/s, per axis
  kVolumeChange,      ///< J - 1, dimensionless
  kElasticStrain,     ///< B = be - I: xx yy zz xy xz yz in 3D; xx yy zz xy in 2D
  kAffine,            ///< APIC's C, row by row, 1/s
  kPlasticStrain,     ///< accumulated equivalent plastic strain, dimensionless
  kShare,             ///< mass and volume, over those that a point of the material is sampled with
  kDeformation,       ///< F - I, or F_e - I if it yields, row by row in 3D; xx xy yx yy zz in 2D
  kPlasticity,        ///< |dev C^p|_F as last detected, dimensionless; weak above the tear_threshold
  kPlasticVolume,     ///< J_p - 1, dimensionless
  kVelocityGradient,  ///< of the last step, row by row, 1/s
  kConcentration,  ///< c, dimensionless, double in every run: a step's change may be below a float's digits
  kGrip,           ///< uint32, 1 + index into Scene::grips; 0: free
  kId,             ///< uint32, stable over the run; kNoPoint in empty lanes
  kCell,           ///< int16 per axis, cell index from the domain's lower corner
};
inline constexpr int kFieldCount = 15;
inline constexpr std::uint32_t kNoPoint = 0xffffffffU;

/// A position is a cell index plus a fixed-point fraction of the cell width: plain floats would not move at a
/// time step of 1e-5 s. The quantum is 2^-30 of a cell (float) or 2^-52 (double).
template <class Real>
struct FixedPoint;
template <>
struct FixedPoint<float> {
  using Word = std::int32_t;
  static constexpr int kBits = 30;
};
template <>
struct FixedPoint<double> {
  using Word = std::int64_t;
  static constexpr int kBits = 52;
};

struct TileLayout {
  std::int32_t offset[kFieldCount];  ///< bytes from the tile's start; -1: not planned
  std::int32_t components[kFieldCount] = {};
  std::int32_t component_bytes[kFieldCount] = {};  ///< of one value
  std::int32_t stride = 0;                         ///< bytes of a tile, a multiple of 64

  TileLayout() {
    for (std::int32_t& at : offset) at = -1;
  }
  [[nodiscard]] bool has(Field f) const { return offset[static_cast<int>(f)] >= 0; }
};

/// The layout of a tile that holds exactly `fields`, for points of precision Real in 2 or 3 dimensions.
template <class Real>
[[nodiscard]] TileLayout make_layout(int dimension, const std::vector<Field>& fields);

/// A field's name as plans and docs show it.
[[nodiscard]] const char* to_string(Field field);

}  // namespace lather
