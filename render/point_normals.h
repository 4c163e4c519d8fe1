#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace lather::render {

/// Outward normal of the body that the points make up, in x, y, z (-127 … 127), and how much it is one (0 …
/// 127): 127 at a surface, 0 deep inside and at a lone point.
using PackedNormal = std::array<std::int8_t, 4>;

/// Foam drawn as spheres of a pixel or two is white noise; lit by these normals it shows its shape. They are
/// the negative gradient of the points' smoothed number density, as in smoothed-particle hydrodynamics, on a
/// grid twice as wide as the points' initial distance, which is 2 `point_radius` (m). One a point.
[[nodiscard]] std::vector<PackedNormal> point_normals(const std::vector<std::array<float, 3>>& positions,
                                                      double point_radius);

}  // namespace lather::render
