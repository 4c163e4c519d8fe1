#include <algorithm>
#include <cmath>

#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

using Kind = decltype(Shape::kind);

constexpr std::size_t kMaxParts = 256;
constexpr std::size_t kMaxProfile = 1024;

Codec<double> length() {
  return number("m", above_to(0, kMaxLength));
}
Codec<double> length_or_zero() {
  return number("m", from_to(0, kMaxLength));
}
Codec<Vec3> lengths() {
  return vector("m", above_to(0, kMaxLength), Third::kLargest);
}
Codec<std::vector<ShapePtr>> parts() {
  return list_of(shape_codec(), 1, kMaxParts, "shapes");
}

/// Refuses a rounding that is larger than `most`.
void check_rounding(const Value& value, double rounding, double most, const Place& place) {
  if (rounding <= most) return;
  place.at("rounding")
      .refuse(value.find("rounding"), "at most half the smallest size, " + write_json(most) + " m",
              "The rounding does not fit into the shape.");
}

void check_box(const Value& value, BoxShape& s, const Place& place) {
  check_rounding(value, s.rounding, 0.5 * s.size.minCoeff(), place);
}

Table<BoxShape> box_table(Presence rounding) {
  return {rounding == Presence::kRequired ? "rounded_box" : "box",
          "Edges along the axes, centre at the origin.",
          {required<BoxShape>("size", &BoxShape::size, lengths(), "lengths of the edges"),
           field<BoxShape>(rounding, "rounding", &BoxShape::rounding, length_or_zero(),
                           "radius of rounded edges, inside the size")},
          {},
          check_box};
}

Table<CylinderShape> cylinder_table() {
  using S = CylinderShape;
  return {
      "cylinder",
      "Axis along y, centre at the origin.",
      {required<S>("radius", &S::radius, length(), "radius"),
       required<S>("height", &S::height, length(), "height"),
       optional<S>("rounding", &S::rounding, length_or_zero(), "radius of rounded rims, inside the size")},
      {},
      [](const Value& value, S& s, const Place& place) {
        check_rounding(value, s.rounding, std::min(s.radius, 0.5 * s.height), place);
      }};
}

Table<ConeShape> cone_table() {
  using S = ConeShape;
  return {"cone",
          "Axis along y: the base at -height/2, the top at +height/2.",
          {required<S>("radius", &S::radius, length_or_zero(), "radius of the base"),
           optional<S>("top_radius", &S::top_radius, length_or_zero(), "radius of the top; 0 is a tip"),
           required<S>("height", &S::height, length(), "height")},
          {},
          [](const Value& value, S& s, const Place& place) {
            if (s.radius > 0 || s.top_radius > 0) return;
            place.at("radius").refuse(value.find("radius"), "a radius above 0 at one end at least",
                                      "A cone of radius 0 at both ends is empty.");
          }};
}

Table<TorusShape> torus_table() {
  using S = TorusShape;
  return {"torus",
          "A ring in the x-z plane about the origin.",
          {required<S>("ring_radius", &S::ring_radius, length(), "from the centre to the middle of the tube"),
           required<S>("tube_radius", &S::tube_radius, length(), "radius of the tube")},
          {},
          [](const Value& value, S& s, const Place& place) {
            if (s.tube_radius <= s.ring_radius) return;
            place.at("tube_radius")
                .refuse(value.find("tube_radius"), "at most the ring_radius",
                        "The tube is thicker than the ring.");
          }};
}

double twice_area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& a = polygon[i];
    const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice);
}

Table<RevolutionShape> revolution_table() {
  using S = RevolutionShape;
  return {
      "revolution",
      "A polygon of points [r, y] turned about the y axis; it closes by itself and must not cross itself.",
      {required<S>(
          "profile", &S::profile,
          list_of(pair_of_numbers("m", from_to(-kMaxLength, kMaxLength)), 3, kMaxProfile, "points [r, y]"),
          "the corners of the polygon in order, r from the axis")},
      {},
      [](const Value& value, S& s, const Place& place) {
        const Place there = place.at("profile");
        const Value* profile = value.find("profile");
        for (std::size_t i = 0; i < s.profile.size(); ++i) {
          if (s.profile[i].x() >= 0) continue;
          there.at(i).refuse((*profile->array())[i], "r of 0 or more", "A point lies beyond the axis.");
        }
        if (!(twice_area(s.profile) > 0)) there.refuse(profile, "an area above 0", "The polygon is flat.");
      }};
}

template <class S>
Table<S> combination_table(const std::string& title, const std::string& words) {
  return {title, words, {required<S>("of", &S::of, parts(), "the shapes")}};
}

Table<UnionShape> union_table() {
  using S = UnionShape;
  return {
      "union",
      "All of the shapes together.",
      {required<S>("of", &S::of, parts(), "the shapes"),
       optional<S>("smoothing", &S::smoothing, length_or_zero(), "width of the blend where shapes meet")}};
}

/// The keys that move a shape; PlacedShape without the shape it places.
const Table<PlacedShape>& placement() {
  using S = PlacedShape;
  static const Table<S> table(
      "placement", "Keys that every shape takes beside its own: x = translate + rotate(scale * x).",
      {optional<S>("translate", &S::translate, vector("m", from_to(-kMaxLength, kMaxLength)), "shift"),
       optional<S>("rotate_deg", &S::rotate_deg, vector("degrees", from_to(-1e6, 1e6)),
                   "turn about x, then y, then z (fixed axes)"),
       optional<S>("scale", &S::scale, number("1", from_to(1e-6, 1e6)), "factor on all lengths")});
  return table;
}

bool moves(const PlacedShape& s) {
  return !s.translate.isZero(0) || !s.rotate_deg.isZero(0) || s.scale != 1;
}

bool read_shape(const Value& value, ShapePtr& out, const Place& place) {
  auto shape = std::make_shared<Shape>();
  PlacedShape placed;
  const bool good = shapes().read(value, shape->kind, place);
  if (value.object() == nullptr || !placement().read_fields(value, placed, place) || !good) return false;
  out = shape;
  if (!moves(placed)) return true;
  out = std::make_shared<const Shape>(
      Shape{PlacedShape(shape, placed.translate, placed.rotate_deg, placed.scale)});
  return true;
}

/// A placed shape is written as its shape with the placement's keys. Where a placement is placed again, a
/// union of one stands between the two.
Object write_shape(const Shape& shape) {
  const auto* placed = std::get_if<PlacedShape>(&shape.kind);
  if (placed == nullptr) return shapes().write(shape.kind);
  const bool twice = std::holds_alternative<PlacedShape>(placed->shape->kind);
  Object object = twice ? shapes().write(UnionShape{{placed->shape}, 0}) : write_shape(*placed->shape);
  if (moves(*placed)) placement().write_fields(*placed, object);
  return object;
}

}  // namespace

const Tagged<Kind>& shapes() {
  static const Tagged<Kind> tagged(
      {
          alternative<Kind>("sphere",
                            Table<SphereShape>(
                                "sphere", "About the origin.",
                                {required<SphereShape>("radius", &SphereShape::radius, length(), "radius")})),
          alternative<Kind>("box", box_table(Presence::kOptional)),
          alternative<Kind>("rounded_box", box_table(Presence::kRequired)),
          alternative<Kind>("cylinder", cylinder_table()),
          alternative<Kind>("capsule",
                            Table<CapsuleShape>(
                                "capsule", "A cylinder along y with half spheres on its ends.",
                                {required<CapsuleShape>("radius", &CapsuleShape::radius, length(), "radius"),
                                 required<CapsuleShape>("height", &CapsuleShape::height, length_or_zero(),
                                                        "between the centres of the half spheres")})),
          alternative<Kind>("cone", cone_table()),
          alternative<Kind>("torus", torus_table()),
          alternative<Kind>("ellipsoid", Table<EllipsoidShape>("ellipsoid", "About the origin.",
                                                               {required<EllipsoidShape>(
                                                                   "radii", &EllipsoidShape::radii, lengths(),
                                                                   "half axes along x, y and z")})),
          alternative<Kind>(
              "plane", Table<PlaneShape>("plane", "The half space below the plane through the origin.",
                                         {optional<PlaneShape>("normal", &PlaneShape::normal, direction(),
                                                               "out of the half space, of any length")})),
          alternative<Kind>("revolution", revolution_table()),
          alternative<Kind>("mesh", mesh_table()),
          alternative<Kind>("union", union_table()),
          alternative<Kind>("intersection",
                            combination_table<IntersectionShape>("intersection", "What all shapes share.")),
          alternative<Kind>("difference", combination_table<DifferenceShape>(
                                              "difference", "The first shape without all others.")),
      },
      placement().info().fields);
  return tagged;
}

Codec<ShapePtr> shape_codec() {
  Codec<ShapePtr> codec;
  codec.allowed = "an object, see shapes";
  codec.schema = {{"$ref", "#/$defs/shape"}};
  codec.read = read_shape;
  codec.write = [](const ShapePtr& shape) { return Value(write_shape(*shape)); };
  return codec;
}

}  // namespace lather::tables
