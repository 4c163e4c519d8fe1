#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/rgba.h"
#include "sim/frame.h"
#include "sim/scene/look.h"

namespace lather::render {

/// What the colours of a picture mean, for the legend.
struct ColorScale {
  std::string name;  ///< "speed"
  std::string unit;  ///< "m/s"; "1" for none
  double low = 0, high = 1;
  std::string map;  ///< name of the colour map
};

struct PointColors {
  std::vector<Rgba> colors;         ///< one a point
  std::optional<ColorScale> scale;  ///< none when coloured by material
};

/// Of one material, sRGB: the look's own, or from a palette.
[[nodiscard]] std::array<double, 3> material_color(const Look& look, std::size_t material);

/// Colours by the look's `color_by`. Throws std::runtime_error when the frame has no such scalar or a value
/// of it is not finite, InputError for an unknown colour map.
[[nodiscard]] PointColors color_points(const Frame& frame, const Look& look);

}  // namespace lather::render
