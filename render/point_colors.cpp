#include "render/point_colors.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/colormap.h"

namespace lather::render {
namespace {

using Color = std::array<double, 3>;

// Foam white first; then muted colours that stay apart from each other and from the obstacles' browns and
// greys.
const std::array<Color, 6> kPalette = {Color{0.93, 0.93, 0.92}, Color{0.85, 0.55, 0.45},
                                       Color{0.45, 0.62, 0.80}, Color{0.90, 0.78, 0.45},
                                       Color{0.52, 0.72, 0.55}, Color{0.70, 0.56, 0.76}};

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

std::vector<Rgba> material_colors(const Frame& frame, const Look& look) {
  std::vector<Rgba> colors;
  colors.reserve(frame.points.size());
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const std::size_t material = i < frame.points.material.size() ? frame.points.material[i] : 0;
    const Color c = material_color(look, material);
    colors.push_back({to_byte(c[0]), to_byte(c[1]), to_byte(c[2]), 255});
  }
  return colors;
}

PointScalar speed_of(const FramePoints& points) {
  PointScalar speed{"speed", "m/s", {}};
  speed.values.reserve(points.velocity.size());
  for (const auto& v : points.velocity) speed.values.push_back(std::hypot(v[0], v[1], v[2]));
  return speed;
}

PointScalar find_scalar(const Frame& frame, const std::string& name) {
  std::string known = "speed";
  for (const PointScalar& scalar : frame.points.scalars) {
    if (scalar.name == name) return scalar;
    known += ", " + scalar.name;
  }
  if (name == "speed") return speed_of(frame.points);
  throw std::runtime_error("The points cannot be coloured by '" + name + "': this frame carries " + known +
                           ".");
}

void check_values(const Frame& frame, const PointScalar& scalar) {
  if (scalar.values.size() != frame.points.size())
    throw std::runtime_error("The scalar '" + scalar.name + "' has " + std::to_string(scalar.values.size()) +
                             " values for " + std::to_string(frame.points.size()) + " points.");
  for (std::size_t i = 0; i < scalar.values.size(); ++i)
    if (!std::isfinite(scalar.values[i]))
      throw std::runtime_error("Frame " + std::to_string(frame.index) + " is not drawn: " + scalar.name +
                               " of point " + std::to_string(i) + " is not finite.");
}

ColorScale scale_of(const PointScalar& scalar, const Look& look) {
  ColorScale scale{scalar.name, scalar.unit, 0, 1, look.color_map};
  if (look.color_range) {
    scale.low = (*look.color_range)[0];
    scale.high = (*look.color_range)[1];
  } else if (!scalar.values.empty()) {
    const auto [low, high] = std::minmax_element(scalar.values.begin(), scalar.values.end());
    scale.low = *low;
    scale.high = *high;
  }
  // All values alike: a range around them that float can tell apart.
  if (!(scale.high > scale.low)) scale.high = scale.low + std::max(1e-6, 1e-3 * std::abs(scale.low));
  return scale;
}

}  // namespace

std::array<double, 3> material_color(const Look& look, std::size_t material) {
  return material < look.material_colors.size() ? look.material_colors[material]
                                                : kPalette[material % kPalette.size()];
}

PointColors color_points(const Frame& frame, const Look& look) {
  PointColors result;
  if (look.color_by == "material") {
    result.colors = material_colors(frame, look);
    return result;
  }
  const PointScalar scalar = find_scalar(frame, look.color_by);
  check_values(frame, scalar);
  const ColorMap map = ColorMap::named(look.color_map);
  const ColorScale scale = scale_of(scalar, look);
  result.colors.reserve(scalar.values.size());
  for (const float value : scalar.values)
    result.colors.push_back(map.at((value - scale.low) / (scale.high - scale.low)));
  result.scale = scale;
  return result;
}

}  // namespace lather::render
