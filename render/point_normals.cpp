#include "render/point_normals.h"

#include <algorithm>
#include <cmath>

#include "render/camera.h"

namespace lather::render {
namespace {

constexpr double kMostCells =
    1 << 23;  // of the density grid, 4 bytes each; thin spray over a wide domain gets wider ones
constexpr int kMargin = 3;  // empty cells around the points: gradient and blur look no further

/// Number density at the nodes of a regular grid, in points a cell.
struct Density {
  Vec3 origin = Vec3::Zero();
  double cell = 1;                      // m
  std::array<int, 3> size = {0, 0, 0};  // nodes
  std::vector<float> values;            // x fastest

  [[nodiscard]] std::ptrdiff_t stride(int axis) const {
    return axis == 0 ? 1 : axis == 1 ? size[0] : std::ptrdiff_t{1} * size[0] * size[1];
  }
};

/// The eight nodes around a point and their linear weights.
struct Corners {
  std::ptrdiff_t first;
  std::array<float, 8> weights;
};

Corners corners_of(const Density& grid, const std::array<float, 3>& position) {
  Corners corners{0, {}};
  std::array<float, 3> offset{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double at = (position[a] - grid.origin[axis]) / grid.cell;
    const double node = std::floor(at);
    offset[a] = static_cast<float>(at - node);
    corners.first += static_cast<std::ptrdiff_t>(node) * grid.stride(axis);
  }
  for (unsigned i = 0; i < 8; ++i) {
    float weight = 1;
    for (unsigned a = 0; a < 3; ++a) weight *= (i >> a) & 1 ? offset[a] : 1 - offset[a];
    corners.weights[i] = weight;
  }
  return corners;
}

std::ptrdiff_t corner_offset(const Density& grid, unsigned i) {
  return static_cast<std::ptrdiff_t>(i & 1) + ((i >> 1) & 1) * grid.stride(1) +
         ((i >> 2) & 1) * grid.stride(2);
}

Density empty_density(const std::vector<std::array<float, 3>>& positions, double cell) {
  Box3 box = empty_box();
  for (const auto& p : positions) box.include(Vec3(p[0], p[1], p[2]));
  Density grid;
  const auto nodes = [&](double width) -> Vec3 {
    return (box.extent() / width).array().floor() + 2.0 + 2.0 * kMargin;
  };
  while (nodes(cell).prod() > kMostCells) cell *= 1.25;
  grid.cell = cell;
  grid.origin = box.min - Vec3::Constant(kMargin * cell);
  for (int axis = 0; axis < 3; ++axis)
    grid.size[static_cast<std::size_t>(axis)] = static_cast<int>(nodes(cell)[axis]);
  grid.values.assign(static_cast<std::size_t>(nodes(cell).prod()), 0.0F);
  return grid;
}

/// (1, 2, 1) / 4 along an axis. The rim is empty and stays so.
void blur(Density& grid, int axis) {
  const std::ptrdiff_t step = grid.stride(axis);
  const std::vector<float> before = grid.values;
  const auto end = static_cast<std::ptrdiff_t>(before.size()) - step;
  for (std::ptrdiff_t i = step; i < end; ++i) {
    const float* b = before.data() + i;
    grid.values[static_cast<std::size_t>(i)] = 0.25F * (b[-step] + b[step]) + 0.5F * b[0];
  }
}

Density smoothed_density(const std::vector<std::array<float, 3>>& positions, double cell) {
  Density grid = empty_density(positions, cell);
  for (const auto& position : positions) {
    const Corners corners = corners_of(grid, position);
    for (unsigned i = 0; i < 8; ++i)
      grid.values[static_cast<std::size_t>(corners.first + corner_offset(grid, i))] += corners.weights[i];
  }
  for (int axis = 0; axis < 3; ++axis) blur(grid, axis);
  return grid;
}

/// Points a cell and cell width.
Eigen::Vector3f gradient(const Density& grid, const Corners& corners) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (unsigned i = 0; i < 8; ++i) {
    const float* at = grid.values.data() + corners.first + corner_offset(grid, i);
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += corners.weights[i] * 0.5F * (at[grid.stride(axis)] - at[-grid.stride(axis)]);
  }
  return sum;
}

}  // namespace

std::vector<PackedNormal> point_normals(const std::vector<std::array<float, 3>>& positions,
                                        double point_radius) {
  if (positions.empty()) return {};
  const Density grid = smoothed_density(positions, std::max(4 * point_radius, 1e-9));
  // A flat surface of points at their initial distance drops from 8 points a cell to none over about three
  // cells.
  const float full = static_cast<float>(std::pow(grid.cell / (2 * point_radius), 3) / 4);
  std::vector<PackedNormal> normals;
  normals.reserve(positions.size());
  for (const auto& position : positions) {
    const Eigen::Vector3f outward = -gradient(grid, corners_of(grid, position));
    const float length = outward.norm();
    const Eigen::Vector3f unit =
        length > 0 ? Eigen::Vector3f(outward * (127 / length)) : Eigen::Vector3f::Zero();
    const float weight = std::clamp(2 * length / full - 0.3F, 0.0F, 1.0F);
    normals.push_back({static_cast<std::int8_t>(std::lround(unit.x())),
                       static_cast<std::int8_t>(std::lround(unit.y())),
                       static_cast<std::int8_t>(std::lround(unit.z())),
                       static_cast<std::int8_t>(std::lround(127 * weight))});
  }
  return normals;
}

}  // namespace lather::render
