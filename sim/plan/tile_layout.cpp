#include "sim/plan/tile_layout.h"

#include <algorithm>
#include <utility>

namespace lather {

const char* to_string(Field field) {
  switch (field) {
    case Field::kFraction:
      return "position in cell";
    case Field::kVelocity:
      return "velocity";
    case Field::kVolumeChange:
      return "volume change J - 1";
    case Field::kElasticStrain:
      return "elastic strain be - I";
    case Field::kAffine:
      return "affine velocity C";
    case Field::kPlasticStrain:
      return "plastic strain";
    case Field::kShare:
      return "share of mass";
    case Field::kDeformation:
      return "deformation F - I";
    case Field::kPlasticity:
      return "plasticity |dev Cp|";
    case Field::kPlasticVolume:
      return "plastic volume change Jp - 1";
    case Field::kVelocityGradient:
      return "velocity gradient";
    case Field::kConcentration:
      return "concentration";
    case Field::kGrip:
      return "grip";
    case Field::kId:
      return "id";
    case Field::kCell:
      return "cell";
  }
  return "";
}

template <class Real>
TileLayout make_layout(int dimension, const std::vector<Field>& fields) {
  const int d = dimension;
  const int real = sizeof(Real);
  const auto shape = [&](Field f) -> std::pair<int, int> {  // components, bytes of one
    switch (f) {
      case Field::kFraction:
        return {d, static_cast<int>(sizeof(typename FixedPoint<Real>::Word))};
      case Field::kVelocity:
        return {d, real};
      case Field::kVolumeChange:
        return {1, real};
      case Field::kElasticStrain:
        return {d == 3 ? 6 : 4, real};
      case Field::kAffine:
      case Field::kVelocityGradient:
        return {d * d, real};
      case Field::kPlasticStrain:
      case Field::kPlasticity:
      case Field::kPlasticVolume:
      case Field::kShare:
        return {1, real};
      case Field::kDeformation:
        return {d == 3 ? 9 : 5, real};
      case Field::kConcentration:
        return {1, 8};
      case Field::kGrip:
      case Field::kId:
        return {1, 4};
      case Field::kCell:
        return {d, 2};
    }
    return {0, 0};
  };
  TileLayout layout;
  std::int32_t at = 0;
  for (int i = 0; i < kFieldCount;
       ++i) {  // in the order of the enum: fields of 64-byte rows first, cells last
    const auto f = static_cast<Field>(i);
    if (std::find(fields.begin(), fields.end(), f) == fields.end()) continue;
    const auto [components, bytes] = shape(f);
    layout.offset[i] = at;
    layout.components[i] = components;
    layout.component_bytes[i] = bytes;
    at += components * bytes * kTile;
  }
  layout.stride = (at + 63) / 64 * 64;
  return layout;
}

template TileLayout make_layout<float>(int, const std::vector<Field>&);
template TileLayout make_layout<double>(int, const std::vector<Field>&);

}  // namespace lather
