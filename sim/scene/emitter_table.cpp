#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

constexpr int kMaxReleases = 1'000'000;

Codec<double> time() {
  return number("s", from_to(0, kForever));
}

void check_stream(const Value& value, const Emitter& e, const Place& place) {
  if (e.velocity.isZero(0))
    place.at("velocity")
        .refuse(value.find("velocity"), "not zero where stream is true",
                "A stream comes in through its shape at this velocity; without one nothing comes.");
  if (!e.spin_deg.isZero(0))
    place.at("spin_deg")
        .refuse(value.find("spin_deg"), "only where stream is false", "A stream cannot spin.");
  const char* copies = e.interval != 0 ? "interval" : e.count != 1 ? "count" : nullptr;
  if (copies != nullptr)
    place.at(copies).refuse(value.find(copies), "only where stream is false",
                            "A stream does not come in copies; its last moment is \"end\".");
  if (e.end <= e.start)
    place.at("end").refuse(value.find("end"), "later than start, " + write_json(e.start) + " s",
                           "The stream ends before it starts.");
}

void check_emitter(const Value& value, Emitter& e, const Place& place) {
  if (e.stream) {
    check_stream(value, e, place);
    return;
  }
  if (e.count > 1 && e.interval <= 0)
    place.at("interval")
        .refuse(value.find("interval"), "above 0 s where count is more than 1",
                "Several releases need the time from one to the next.");
  if (value.find("end") != nullptr && e.end < kForever)
    place.at("end").refuse(value.find("end"), "only where stream is true",
                           "Releases are limited by \"count\"; take out \"end\".");
}

}  // namespace

const Table<Emitter>& emitter() {
  using E = Emitter;
  static const Table<E> table(
      "emitter",
      "Material that comes in during the run: copies of a shape, released one after another, or a stream "
      "through "
      "the shape. What is due comes in with the first step that starts at or after its time. A release waits "
      "while "
      "any point of material is in its place, or closer than half a distance of points; it then comes as "
      "soon as "
      "the place is free, and later ones keep their own times. A stream halts likewise. The report counts "
      "what "
      "waited and how long.",
      {required<E>("name", &E::name, text(1, 64), "for messages and reports"),
       required<E>("material", &E::material, text(1, 64), "the name of a material"),
       required<E>(
           "shape", &E::shape, shape_codec(),
           "the form and place of each copy, or the opening that a stream fills; parts outside the domain "
           "are cut off"),
       optional<E>("velocity", &E::velocity, vector("m/s", from_to(-kMaxSpeed, kMaxSpeed)),
                   "of what comes in"),
       optional<E>("spin_deg", &E::spin_deg, vector("degrees/s", from_to(-1e8, 1e8)),
                   "angular velocity about each copy's centre of mass"),
       optional<E>("start", &E::start, time(), "when the first copy, or the stream, comes in"),
       optional<E>("interval", &E::interval, time(), "from one release to the next; above 0 with several"),
       optional<E>("count", &E::count, integer(1, kMaxReleases),
                   "releases; those after the run's end never come"),
       optional<E>("stream", &E::stream, flag(),
                   "fill the shape once, then add material behind what has moved on at velocity"),
       optional<E>("end", &E::end, time(), "when a stream ends")},
      {}, check_emitter);
  return table;
}

}  // namespace lather::tables
