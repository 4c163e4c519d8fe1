#pragma once

// A law's constants at the concentrations of a tile's points, and how these concentrations change. Compiled
// per kernel level.

#include <cstring>
#include <type_traits>

#include "sim/material/volume_correction.h"
#include "sim/mlsrk/kernels.h"
#include "sim/particles/tile.h"

namespace lather::LATHER_LEVEL {

/// Entries of a table over concentrations, linear in between; concentrations beyond 0 … 1 read its ends
/// [MLSRK eq. 16 lets c leave them a little].
template <class Real>
struct BetweenNodes {
  int low;
  Real share;  ///< of the node above

  explicit BetweenNodes(double c) {
    const double at = (c > 0 ? c < 1 ? c : 1 : 0) * mlsrk::kConcentrationSteps;
    low = static_cast<int>(at);
    if (low == mlsrk::kConcentrationSteps) --low;
    share = static_cast<Real>(at - low);
  }
  /// `infinite` entries stay what they are.
  Real operator()(Real a, Real b) const { return a == b ? a : a + (b - a) * share; }
};

/// Constants of lanes, by the concentrations of the tile's points; of Real, the material's own.
template <class C, class Real, int Dim>
inline std::conditional_t<std::is_same_v<C, Real>, const LawConstants<Real>&, LawConstants<C>> law_constants(
    const Tile<Real, Dim>& tile, const mlsrk::MaterialConstants<Real>& m) {
  if constexpr (std::is_same_v<C, Real>) {
    return m.law;
  } else {
    using All = LawConstants<C>;
    constexpr int kCount = sizeof(LawConstants<Real>) / sizeof(Real);
    static_assert(sizeof(All) == kCount * sizeof(C) && std::is_trivially_copyable_v<All>,
                  "a struct of nothing but constants");
    const double* c = tile.template field<double>(Field::kConcentration);
    Real lanes[kCount][kLanes];
    for (int k = 0; k < kLanes; ++k) {
      const BetweenNodes<Real> between(c[k]);
      Real nodes[2][kCount];
      std::memcpy(nodes, m.by_concentration + between.low, sizeof nodes);
      for (int n = 0; n < kCount; ++n) lanes[n][k] = between(nodes[0][n], nodes[1][n]);
    }
    C constants[kCount];
    for (int n = 0; n < kCount; ++n) constants[n] = C::load(lanes[n]);
    All all;
    std::memcpy(&all, constants, sizeof all);
    return all;
  }
}

/// See LawKernels::change_concentration. F_e~ = (J_r/J_r~)^(1/d) F_e: F and F_p stay [MLSRK eq. 31], d = Dim.
template <class Real, int Dim, class C>
void change_concentration(const mlsrk::SetTile<Real>& at, const double* change) {
  using T = Lane<Real>;
  const Tile<Real, Dim> tile{at.bytes, at.layout};
  double* c = tile.template field<double>(Field::kConcentration);
  [[maybe_unused]] const C before = law_constants<C>(tile, *at.material).swelling;
  for (int k = 0; k < kLanes; ++k) c[k] += change[k];
  if constexpr (!std::is_same_v<C, Real>) {
    const C after = law_constants<C>(tile, *at.material).swelling;
    const T ratio = (before - after) / after;  // J_r/J_r~ - 1
    if (tile.has(Field::kDeformation)) {
      store_deformation(tile, grown<Dim>(load_deformation(tile), log1p(ratio)));
    } else {
      const T j = tile.lane(Field::kVolumeChange);
      tile.put(Field::kVolumeChange, 0, j + ratio + j * ratio);
    }
  }
}

}  // namespace lather::LATHER_LEVEL
