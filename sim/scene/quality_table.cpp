#include "sim/scene/quality.h"
#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

/// A number that is there or not: 0 stands for "not", and is not written.
Field<Budget> either(const char* name, double Budget::*member, const Codec<double>& codec,
                     const char* words) {
  Field<Budget> field = optional<Budget>(name, member, codec, words, "none");
  field.write = [codec, member](const Budget& b) {
    return b.*member > 0 ? std::optional<Value>(codec.write(b.*member)) : std::nullopt;
  };
  return field;
}

void check_budget(const Value& value, Budget& b, const Place& place) {
  if ((b.seconds > 0) != (b.error > 0)) return;
  place.refuse(value, "{\"seconds\": S} or {\"error\": E}",
               "A budget is of seconds or of an error: give one of the two.");
}

}  // namespace

const Codec<Quality>& quality_codec() {
  static const Codec<Quality> codec = [] {
    std::vector<std::pair<std::string, Quality>> entries;
    for (const QualityPoint& point : quality_points(Solver::kMpm))
      entries.emplace_back(point.name, point.quality);
    return enumeration<Quality>(entries);
  }();
  return codec;
}

const Table<Budget>& budget() {
  static const Table<Budget> table(
      "budget",
      "What the run may take, or by how much it may err. The quality is chosen for it once, before the run: "
      "the "
      "most accurate one that should be done in time, by a trial of the scene on the machine; or the "
      "cheapest "
      "one whose largest error on the solver's exact cases is no larger (docs/tradeoff.md has them).",
      {either("seconds", &Budget::seconds, number("s", above_to(0, 1e9)), "of the whole run, wall clock"),
       either("error", &Budget::error, number("1", above_to(0, 1e3)),
              "largest relative error on the solver's exact cases")},
      {}, check_budget);
  return table;
}

}  // namespace lather::tables
