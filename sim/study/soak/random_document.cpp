#include "sim/study/soak/random_document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/math/counter_rng.h"

namespace lather::study {
namespace {

constexpr double kOptional = 1.0 / 3;  // how often a field is there that need not be
constexpr double kExtreme = 0.02;      // how often a number is an end of its range
constexpr std::size_t kMostItems = 3;
constexpr int kDeep = 6;  // levels of objects and lists below which nothing optional is added

/// What is usual in a unit, drawn evenly over its logarithm.
struct Usual {
  const char* unit;
  double low;
  double high;
};
constexpr std::array<Usual, 8> kUsual = {{{"Pa", 30, 1e6},
                                          {"Pa s", 0.01, 100},
                                          {"Pa s^h", 0.01, 100},
                                          {"kg/m^3", 10, 3000},
                                          {"m^2/s", 1e-7, 1e-3},
                                          {"m/s^2", 0.1, 100},
                                          {"degrees", 1, 180},
                                          {"degrees/s", 1, 1000}}};

/// Names are few, so that most references to them find something.
constexpr std::array<const char*, kMostItems> kNames = {"a", "b", "c"};

double number_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> number_at(const Value& schema, const char* key) {
  const Value* value = schema.find(key);
  return value == nullptr ? std::nullopt : std::optional(number_in(*value));
}

std::string text_at(const Value& schema, const char* key) {
  const Value* value = schema.find(key);
  return value == nullptr || value->text() == nullptr ? std::string() : *value->text();
}

/// The number by which an item of a list stands in its place; 0 for all items where their order is free.
double place_in_order(const Value& item) {
  if (const Value* time = item.find("time")) return number_in(*time);
  const Array* pair = item.array();
  return pair != nullptr && pair->size() == 2 ? number_in(pair->front()) : 0;
}

class Draw {
 public:
  Draw(const Value& root, const Surroundings& surroundings, std::uint64_t seed, std::uint64_t index)
      : root_(root), surroundings_(surroundings), seed_(seed), index_(index) {}

  Value object(const Value& schema, int depth);

 private:
  /// What is known of a value where it stands.
  struct Here {
    std::string key;       ///< of the object that it, or the list that it is in, belongs to
    std::string unit;      ///< "" where there is none
    std::size_t item = 0;  ///< its index in that list
    int depth = 0;
  };

  double unit() { return random_unit(seed_, index_, count_++); }
  bool happens(double share) { return unit() < share; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double by_order(double low, double high) { return low * std::pow(high / low, unit()); }
  std::size_t choose(std::size_t count) {
    return std::min(static_cast<std::size_t>(unit() * static_cast<double>(count)), count - 1);
  }

  Value value(const Value& schema, Here here);
  Value list(const Value& schema, Here here);
  Value mapping(const Value& schema, Here here);
  Value text(const Here& here);
  double number(const Value& schema, const Here& here);
  double usual(const Value& schema, const Here& here, double low, double high);
  std::size_t items(const Value& schema, const Here& here);

  const Value& root_;
  const Surroundings& surroundings_;
  std::uint64_t seed_;
  std::uint64_t index_;
  std::uint64_t count_ = 0;
  std::vector<const Value*> around_;  ///< schemas of the objects around what is drawn, the outermost first
};

Value Draw::value(const Value& schema, Here here) {
  if (const Value* reference = schema.find("$ref")) {
    const Value* target = at_pointer(root_, reference->text()->substr(1));
    return value(*target, std::move(here));
  }
  if (const Value* constant = schema.find("const")) return *constant;
  if (const Value* names = schema.find("enum")) return (*names->array())[choose(names->array()->size())];
  // Of an object, "anyOf" is about which keys go together; see object().
  for (const char* const key : {"oneOf", "anyOf"}) {
    const Value* choices = schema.find(key);
    if (choices == nullptr || schema.find("properties") != nullptr) continue;
    const Array& list = *choices->array();
    // The first of them is the simplest: a sphere, a body at rest.
    return value(list[here.depth < kDeep ? choose(list.size()) : 0], std::move(here));
  }
  const std::string type = text_at(schema, "type");
  if (type == "object")
    return schema.find("properties") != nullptr ? object(schema, here.depth + 1) : mapping(schema, here);
  if (type == "array") return list(schema, std::move(here));
  if (type == "string") return text(here);
  if (type == "boolean") return happens(0.5);
  if (type == "integer") return static_cast<std::int64_t>(std::llround(number(schema, here)));
  if (type == "number") return number(schema, here);
  return nullptr;
}

Value Draw::object(const Value& schema, int depth) {
  std::vector<std::string> needed;
  const auto need = [&](const Value& keys) {
    for (const Value& key : *keys.array()) needed.push_back(*key.text());
  };
  if (const Value* required = schema.find("required")) need(*required);
  if (const Value* groups = schema.find("anyOf")) {
    const Array& list = *groups->array();
    if (const Value* required = list[choose(list.size())].find("required")) need(*required);
  }
  Object made;
  around_.push_back(&schema);
  for (const auto& [key, field] : *schema.find("properties")->object()) {
    const bool required = std::find(needed.begin(), needed.end(), key) != needed.end();
    if (!required && (depth >= kDeep || !happens(kOptional))) continue;
    made.emplace_back(key, value(field, {key, text_at(field, "x-unit"), 0, depth}));
  }
  around_.pop_back();
  return made;
}

/// As many as the schema asks for; where it leaves a choice between two and three, one for each dimension.
std::size_t Draw::items(const Value& schema, const Here& here) {
  const auto least = static_cast<std::size_t>(number_at(schema, "minItems").value_or(0));
  const auto most = static_cast<std::size_t>(number_at(schema, "maxItems").value_or(kMostItems));
  if (least == 2 && most == 3) return static_cast<std::size_t>(surroundings_.dimension);
  if (least >= kMostItems || here.depth >= kDeep) return least;
  const std::size_t fewest = std::max<std::size_t>(least, 1);
  return std::max(least, fewest + choose(std::min(most, kMostItems) - fewest + 1));
}

Value Draw::list(const Value& schema, Here here) {
  Array made;
  const Value* first = schema.find("prefixItems");
  const std::size_t count = first != nullptr ? first->array()->size() : items(schema, here);
  ++here.depth;
  for (std::size_t i = 0; i < count; ++i) {
    here.item = i;
    const Value& item = first != nullptr ? (*first->array())[i] : *schema.find("items");
    made.push_back(value(item, here));
    // Names of a list of objects are the first of those there are, so that references find them.
    if (Value* name = made.back().find("name")) *name = kNames.at(i % kNames.size());
  }
  // What stands in order of a number: keyframes of their time, points of a curve of their first coordinate.
  std::stable_sort(made.begin(), made.end(),
                   [](const Value& a, const Value& b) { return place_in_order(a) < place_in_order(b); });
  return made;
}

/// An object whose keys are those of the second object around it: a phase's curves, by the material's keys.
Value Draw::mapping(const Value& schema, Here here) {
  Object made;
  const Value* each = schema.find("additionalProperties");
  if (each == nullptr || each->object() == nullptr || around_.size() < 2) return made;
  const Object& keys = *around_[around_.size() - 2]->find("properties")->object();
  const std::string& key = keys[choose(keys.size())].first;
  ++here.depth;
  made.emplace_back(key, value(*each, here));
  return made;
}

Value Draw::text(const Here& here) {
  if (here.key == "file") return "mesh.obj";
  return kNames.at(choose(kNames.size()));
}

double Draw::number(const Value& schema, const Here& here) {
  const double low =
      number_at(schema, "minimum")
          .value_or(number_at(schema, "exclusiveMinimum").value_or(-std::numeric_limits<double>::max()));
  const double high =
      number_at(schema, "maximum")
          .value_or(number_at(schema, "exclusiveMaximum").value_or(std::numeric_limits<double>::max()));
  if (happens(kExtreme)) return happens(0.5) ? low : high;
  return std::clamp(usual(schema, here, low, high), low, high);
}

double Draw::usual(const Value& schema, const Here& here, double low, double high) {
  const Vec3& size = surroundings_.size;
  const double sign = low < 0 && happens(0.5) ? -1 : 1;
  if (here.unit == "m" && low < 0) {
    const auto axis = static_cast<Eigen::Index>(std::min<std::size_t>(here.item, 2));
    return surroundings_.corner[axis] + size[axis] * unit();
  }
  if (here.unit == "m") return by_order(surroundings_.spacing, size.maxCoeff());
  if (here.unit == "m/s") return sign * size.maxCoeff() / surroundings_.duration * by_order(1e-3, 1);
  if (here.unit == "s") return surroundings_.duration * unit();
  if (here.unit == "1/s") return sign * by_order(0.1, 10) / surroundings_.duration;
  for (const Usual& u : kUsual)
    if (here.unit == u.unit) return sign * by_order(u.low, u.high);
  const double typical = number_at(schema, "default").value_or(0);
  if (typical != 0 && happens(0.5)) return typical * by_order(0.1, 10);
  const double least = std::max(low, happens(0.25) ? -1.0 : 0.0);
  return between(least, std::min(high, 4 * std::max(1.0, least)));
}

}  // namespace

Value random_document(const Value& scene, const Surroundings& surroundings, std::uint64_t seed,
                      std::uint64_t index) {
  return Draw(scene, surroundings, seed, index).object(scene, 0);
}

}  // namespace lather::study
