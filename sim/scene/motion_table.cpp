#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

constexpr std::size_t kMaxKeys = 10'000;

Codec<double> time() {
  return number("s", from_to(0, kForever));
}
Codec<Vec3> shift() {
  return vector("m", from_to(-kMaxLength, kMaxLength));
}
Codec<Vec3> angles() {
  return vector("degrees", from_to(-1e6, 1e6));
}

template <class M>
void check_span(const Value& value, M& m, const Place& place) {
  if (m.end > m.start) return;
  place.at("end").refuse(value.find("end"), "later than start, " + write_json(m.start) + " s",
                         "The motion ends before it starts.");
}

template <class M>
std::vector<Field<M>> with_span(std::vector<Field<M>> fields) {
  fields.push_back(optional<M>("start", &M::start, time(), "when it starts; at rest before"));
  fields.push_back(optional<M>("end", &M::end, time(), "when it ends; at rest after"));
  return fields;
}

Table<LinearMotion> linear_table() {
  using M = LinearMotion;
  return {"linear",
          "Steady motion along a line.",
          with_span<M>({required<M>("velocity", &M::velocity, vector("m/s", from_to(-kMaxSpeed, kMaxSpeed)),
                                    "velocity")}),
          {},
          check_span<M>};
}

Table<Oscillation> oscillation_table() {
  using M = Oscillation;
  return {
      "oscillation",
      "amplitude * sin(2 pi frequency (t - start) + phase_deg), less its value at start.",
      with_span<M>(
          {optional<M>("direction", &M::direction, direction(), "of any length"),
           required<M>("amplitude", &M::amplitude, number("m", from_to(0, kMaxLength)), "half the whole way"),
           required<M>("frequency", &M::frequency, number("1/s", from_to(0, 1e6)), "full cycles a second"),
           optional<M>("phase_deg", &M::phase_deg, number("degrees", from_to(-1e6, 1e6)), "phase at start")}),
      {},
      check_span<M>};
}

Table<Rotation> rotation_table() {
  using M = Rotation;
  return {"rotation",
          "Steady turning about an axis.",
          with_span<M>({optional<M>("center", &M::center, shift(), "a point of the axis"),
                        optional<M>("axis", &M::axis, direction(), "direction of the axis, of any length"),
                        required<M>("rate_deg", &M::rate_deg, number("degrees/s", from_to(-1e8, 1e8)),
                                    "angle a second, by the right hand about the axis")}),
          {},
          check_span<M>};
}

const Table<Keyframe>& keyframe_table() {
  using K = Keyframe;
  static const Table<K> table(
      "keyframe", "Where the obstacle is at one time.",
      {required<K>("time", &K::time, time(), "later than the key before"),
       optional<K>("translate", &K::translate, shift(), "shift from where the scene puts it"),
       optional<K>("rotate_deg", &K::rotate_deg, angles(),
                   "turn about the scene's origin: about x, then y, then z, before the shift")});
  return table;
}

Table<Keyframes> keyframes_table() {
  return {"keyframes",
          "Smooth motion through given places (cubic Hermite, Catmull-Rom tangents); held before and after.",
          {required<Keyframes>(
              "keys", &Keyframes::keys, list_of(object_of(keyframe_table()), 1, kMaxKeys, "keyframes"),
              "keyframes in the order of time; each takes time (s), translate (m), rotate_deg")},
          {},
          [](const Value& value, Keyframes& m, const Place& place) {
            for (std::size_t i = 1; i < m.keys.size(); ++i) {
              if (m.keys[i].time > m.keys[i - 1].time) continue;
              const Value& key = (*value.find("keys")->array())[i];
              place.at("keys").at(i).at("time").refuse(key.find("time"),
                                                       "later than " + write_json(m.keys[i - 1].time) + " s",
                                                       "Keys must ascend in time.");
            }
          }};
}

}  // namespace

const Tagged<Motion>& motions() {
  static const Tagged<Motion> tagged(
      {alternative<Motion>("rest", Table<AtRest>("rest", "Stays where it is.", {})),
       alternative<Motion>("linear", linear_table()), alternative<Motion>("oscillation", oscillation_table()),
       alternative<Motion>("rotation", rotation_table()),
       alternative<Motion>("keyframes", keyframes_table())},
      {});
  return tagged;
}

Codec<Motion> motion_codec() {
  Codec<Motion> codec;
  codec.allowed = "an object, see motions";
  codec.schema = {{"$ref", "#/$defs/motion"}};
  codec.read = [](const Value& value, Motion& out, const Place& place) {
    return motions().read(value, out, place);
  };
  codec.write = [](const Motion& m) { return Value(motions().write(m)); };
  return codec;
}

}  // namespace lather::tables
