#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

using Kind = decltype(Probe::kind);

Codec<Vec3> place() {
  return vector("m", from_to(-kMaxLength, kMaxLength));
}

/// A value that may be left out; written only when it is there.
template <class T, class V>
Field<T> left_out(std::string name, std::optional<V> T::*member, Codec<V> codec, std::string words,
                  std::string default_words) {
  Field<T> out;
  out.info = {std::move(name),
              std::move(words),
              Presence::kOptional,
              codec.unit,
              codec.allowed,
              codec.schema,
              {},
              std::move(default_words)};
  out.read = [member, read = codec.read](const Value& value, T& target, const Place& at) {
    V given{};
    if (!read(value, given, at)) return false;
    target.*member = given;
    return true;
  };
  out.write = [member, write = codec.write](const T& source) -> std::optional<Value> {
    if (!(source.*member)) return std::nullopt;
    return write(*(source.*member));
  };
  return out;
}

void check_plane_probe(const Value& value, PlaneProbe& p, const Place& at) {
  const bool rectangle = p.size.x() > 0 && p.size.y() > 0;
  if ((p.size.x() > 0) != (p.size.y() > 0))
    at.at("size").refuse(value.find("size"), "two lengths above 0 m, or none", "A rectangle has two edges.");
  if (rectangle && p.radius > 0)
    at.at("radius").refuse(value.find("radius"), "only without size",
                           "It is a disc or a rectangle, not both.");
  if (rectangle && (!p.along || p.along->cross(p.normal).norm() < 1e-6 * p.along->norm() * p.normal.norm()))
    at.at("along").refuse(value.find("along"), "a direction across the normal",
                          "A rectangle needs the direction of its first edge.");
}

Table<ForceProbe> force_table() {
  using P = ForceProbe;
  return {
      "force",
      "Force (N) and torque (N m) of the material on an obstacle: means over the time since the last sample "
      "of "
      "the impulses that contact exchanges. In 2D, per metre of depth.",
      {required<P>("obstacle", &P::obstacle, text(1, 64), "the name of an obstacle"),
       left_out<P, Vec3>("about", &P::about, place(),
                         "where torque is taken about, as the obstacle stands in the scene; moves with it",
                         "the `translate` of its shape")}};
}

Table<WallProbe> wall_table() {
  using P = WallProbe;
  return {"walls",
          "The same for the faces of the domain that are neither periodic nor open, all together.",
          {optional<P>("about", &P::about, place(), "where torque is taken about")}};
}

Table<PointProbe> point_table() {
  using P = PointProbe;
  return {"point",
          "Velocity, density, volume fraction, pressure and von Mises stress of the material around a place, "
          "weighted "
          "with the grid's kernel; all 0 where there is none.",
          {required<P>("at", &P::at, place(), "the place"),
           optional<P>("obstacle", &P::obstacle, text(0, 64), "moves with this obstacle", "fixed")}};
}

Table<PlaneProbe> plane_table() {
  using P = PlaneProbe;
  return {"plane",
          "Mass flux (kg/s, mean since the last sample) and mass that has passed since the start, along the "
          "normal, "
          "through a plane, disc or rectangle; area of it that lies in material; mass of all points above "
          "the whole "
          "plane. In 2D, per metre of depth, and a length for an area.",
          {required<P>("point", &P::point, place(), "a point of the plane; the disc's or rectangle's centre"),
           optional<P>("normal", &P::normal, direction(), "of any length"),
           optional<P>("radius", &P::radius, number("m", from_to(0, kMaxLength)),
                       "of the disc; in 2D, half the length of the segment; 0: not a disc"),
           left_out<P, Vec3>("along", &P::along, direction(), "direction of the rectangle's first edge",
                             "none: not a rectangle"),
           optional<P>("size", &P::size, pair_of_numbers("m", from_to(0, kMaxLength)),
                       "of the rectangle, along its first edge and across; 0: not a rectangle")},
          {},
          check_plane_probe};
}

/// What all probes have beside their kind's own keys.
const Table<Probe>& common() {
  static const Table<Probe> table(
      "probe", "",
      {required<Probe>("name", &Probe::name, text(1, 64), "in the report and the CSV"),
       optional<Probe>("interval", &Probe::interval, number("s", from_to(0, kForever)),
                       "between samples; each is taken after the first step that ends at or after its time",
                       "that of frames")});
  return table;
}

}  // namespace

const Tagged<Kind>& probes() {
  static const Tagged<Kind> tagged(
      {alternative<Kind>("force", force_table()), alternative<Kind>("walls", wall_table()),
       alternative<Kind>("point", point_table()), alternative<Kind>("plane", plane_table())},
      common().info().fields);
  return tagged;
}

Codec<Probe> probe_codec() {
  Codec<Probe> codec;
  codec.allowed = "an object, see probes";
  codec.schema = probes().schema();
  codec.read = [](const Value& value, Probe& out, const Place& at) {
    const bool good = probes().read(value, out.kind, at);
    return value.object() != nullptr && common().read_fields(value, out, at) && good;
  };
  codec.write = [](const Probe& p) {
    Object object = probes().write(p.kind);
    common().write_fields(p, object);
    return Value(std::move(object));
  };
  return codec;
}

}  // namespace lather::tables
