#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "sim/frame.h"
#include "sim/math/vec.h"

/// Shapes as signed distances: negative inside, positive outside, metres.
///
/// distance() is exact for the primitives; for combinations and non-uniform ellipsoids it is a bound that
/// never exceeds the true distance in magnitude (1-Lipschitz), so that "further than d" can be trusted. A
/// mesh's is read from a grid: see mesh_solid.h.
namespace lather {

class MeshSolid;
struct Shape;
using ShapePtr = std::shared_ptr<const Shape>;

// Primitives stand at the origin, axes along y; Placed moves them. A shape owns its parameters.
struct SphereShape {
  double radius = 0;
};
struct BoxShape {  ///< also the rounded box: the rounding lies inside `size`
  Vec3 size = Vec3::Zero();
  double rounding = 0;
};
struct CylinderShape {
  double radius = 0;
  double height = 0;
  double rounding = 0;
};
struct CapsuleShape {  ///< a segment of `height` between the centres of its two half spheres
  double radius = 0;
  double height = 0;
};
struct ConeShape {  ///< base circle at y = -height/2, top circle (0: a tip) at y = +height/2
  double radius = 0;
  double top_radius = 0;
  double height = 0;
};
struct TorusShape {  ///< ring in the x-z plane
  double ring_radius = 0;
  double tube_radius = 0;
};
struct EllipsoidShape {
  Vec3 radii = Vec3::Zero();
};
struct PlaneShape {  ///< half space below the plane through the origin
  Vec3 normal = Vec3::UnitY();
};
struct RevolutionShape {  ///< closed polygon (r, y) turned about the y axis; r >= 0, at least 3 points
  std::vector<Eigen::Vector2d> profile;
};
struct MeshShape {       ///< a closed surface of triangles from a file, in the file's own frame, metres
  std::string file;      ///< as the scene names it
  int resolution = 128;  ///< cells of its distance along the longest side
  std::string sha256;    ///< of the file's bytes, 64 hex digits
  std::shared_ptr<const MeshSolid> solid;
};
struct UnionShape {
  std::vector<ShapePtr> of;
  double smoothing = 0;  ///< width of the blend, m; 0 is the plain union
};
struct IntersectionShape {
  std::vector<ShapePtr> of;
};
struct DifferenceShape {  ///< the first without all others
  std::vector<ShapePtr> of;
};
struct PlacedShape {  ///< x_world = translate + rotation * (scale * x_local)
  PlacedShape() = default;
  explicit PlacedShape(ShapePtr placed, const Vec3& by = Vec3::Zero(), const Vec3& turned_deg = Vec3::Zero(),
                       double scaled = 1);
  ShapePtr shape;
  Vec3 translate = Vec3::Zero();
  Vec3 rotate_deg = Vec3::Zero();  ///< about x, then y, then z (fixed axes)
  Mat3 rotation =
      Mat3::Identity();  ///< rotate_deg as a matrix, made once by the constructor: distance() is hot
  double scale = 1;
};

struct Shape {
  std::variant<SphereShape, BoxShape, CylinderShape, CapsuleShape, ConeShape, TorusShape, EllipsoidShape,
               PlaneShape, RevolutionShape, MeshShape, UnionShape, IntersectionShape, DifferenceShape,
               PlacedShape>
      kind;
};

/// Signed distance of `x` from the surface, m.
[[nodiscard]] double distance(const Shape& shape, const Vec3& x);

/// Outward unit normal by central differences of distance() with step `h`; (0, 1, 0) where the gradient
/// vanishes.
[[nodiscard]] Vec3 normal(const Shape& shape, const Vec3& x, double h);

/// A box that holds the shape; a plane's is clipped to `world`.
[[nodiscard]] Box3 bounds(const Shape& shape, const Box3& world);

/// The surface as triangles for pictures, clipped to `world`, with edges kept sharp where a primitive has
/// them; `detail` is the wanted edge length, m. Combinations are meshed from their distance.
[[nodiscard]] TriangleMesh tessellate(const Shape& shape, const Box3& world, double detail);

}  // namespace lather
