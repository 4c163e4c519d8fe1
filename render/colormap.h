#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "render/rgba.h"

namespace lather::render {

/// Nine evenly spaced sRGB colours, joined by straight lines. Perceptually uniform: lightness is monotone
/// (coolwarm rises to its middle and falls from there).
class ColorMap {
 public:
  /// "viridis", "inferno", "coolwarm" or "gray"; throws InputError for anything else.
  [[nodiscard]] static ColorMap named(std::string_view name);
  /// `t` is clamped to [0, 1].
  [[nodiscard]] Rgba at(double t) const;

 private:
  using Table = std::array<std::uint32_t, 9>;  ///< 0xRRGGBB
  explicit ColorMap(const Table& table) : table_(&table) {}
  const Table* table_;
};

}  // namespace lather::render
