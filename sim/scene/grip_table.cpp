#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

Codec<double> time() {
  return number("s", from_to(0, kForever));
}

void check_grip(const Value& value, Grip& g, const Place& place) {
  if (g.body.empty() && g.shape == nullptr)
    place.at("body").refuse(nullptr, "the name of a body, or none where there is a shape",
                            "Nothing says which points are meant; give \"body\", \"shape\" or both.");
  if (g.end <= g.start)
    place.at("end").refuse(value.find("end"), "later than start, " + write_json(g.start) + " s",
                           "The grip ends before it starts.");
}

/// A shape that may be left out.
Field<Grip> shape_field() {
  Field<Grip> out =
      optional<Grip>("shape", &Grip::shape, shape_codec(),
                     "takes the points that lie inside it at t = 0; later it means nothing", "everywhere");
  out.write = [write = out.write](const Grip& g) { return g.shape != nullptr ? write(g) : std::nullopt; };
  return out;
}

/// A body that may be left out.
Field<Grip> body_field() {
  Field<Grip> out =
      optional<Grip>("body", &Grip::body, text(1, 64), "takes the points of this body", "every body");
  out.write = [write = out.write](const Grip& g) { return g.body.empty() ? std::nullopt : write(g); };
  return out;
}

}  // namespace

const Table<Grip>& grip() {
  static const Table<Grip> table(
      "grip",
      "Points of bodies that are held, or driven along a path, whatever forces, obstacles and walls say: the "
      "velocity of each is prescribed, and all else about it is as of any other point. A point that is at x "
      "when the grip starts is at T(t) T(start)^-1 x afterwards, T being the motion's placement. The grip "
      "starts and ends with the first step that starts at or after the time given; before and after, its "
      "points move freely. A point that two grips take is the earlier one's.",
      {required<Grip>("name", &Grip::name, text(1, 64), "for messages"), body_field(), shape_field(),
       optional<Grip>("motion", &Grip::motion, motion_codec(), "how the points move, as of obstacles",
                      "{\"type\": \"rest\"}"),
       optional<Grip>("start", &Grip::start, time(), "when the points are taken"),
       optional<Grip>("end", &Grip::end, time(), "when they are let go")},
      {}, check_grip);
  return table;
}

}  // namespace lather::tables
