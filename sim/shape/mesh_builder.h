#pragma once

#include <vector>

#include "sim/shape/shape.h"

/// Parts of tessellate(): sharp meshes of the primitives, and the mesh of any distance.
namespace lather::tessellation {

/// Points are shared inside a smooth patch and doubled, bit for bit, along sharp edges.
class MeshBuilder {
 public:
  std::uint32_t add(const Vec3& position, const Vec3& normal);
  /// Corners counter-clockwise seen from outside. Leaves out triangles with two equal corners.
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
  [[nodiscard]] TriangleMesh take() { return std::move(mesh_); }

 private:
  TriangleMesh mesh_;
};

/// A point of a profile curve in the half plane (r, y), with its outward normal there.
struct ProfilePoint {
  Eigen::Vector2d position;
  Eigen::Vector2d normal;
};
/// A smooth stretch of profile, walked so that the solid lies on the left: bottom to top along the outer
/// side.
using ProfileStrip = std::vector<ProfilePoint>;

/// The strips turned about the y axis in steps of at most `detail` along the widest circle.
[[nodiscard]] TriangleMesh lathe(const std::vector<ProfileStrip>& strips, double detail);

/// The box with rounded edges (sharp where rounding is 0).
[[nodiscard]] TriangleMesh rounded_box(const BoxShape& box, double detail);

/// The part of the plane through `point` that lies in `world`, as one flat polygon.
[[nodiscard]] TriangleMesh plane_polygon(const Vec3& point, const Vec3& normal, const Box3& world);

/// Marching tetrahedra on the distance over its bounds; closed. Cells are at least `detail` wide, wider where
/// more than four million of them were needed.
[[nodiscard]] TriangleMesh from_distance(const Shape& shape, const Box3& world, double detail);

}  // namespace lather::tessellation
