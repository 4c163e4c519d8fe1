#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>

#include "sim/math/vec.h"
#include "sim/scene/descriptor.h"

/// Codecs of the value types that scenes are made of.
namespace lather::descriptor {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Numbers from min to max; an open end is itself not allowed.
struct Range {
  double min = -kInfinity;
  double max = kInfinity;
  bool open_min = false;
  bool open_max = false;

  [[nodiscard]] bool holds(double x) const;
  [[nodiscard]] std::string words(const std::string& unit) const;  ///< "from 0 (not itself) to 1 m"
  void add_to(Object& schema) const;
};
[[nodiscard]] inline Range from_to(double min, double max) {
  return {min, max, false, false};
}
[[nodiscard]] inline Range above_to(double min, double max) {
  return {min, max, true, false};
}

[[nodiscard]] Codec<double> number(std::string unit, Range range);
/// A number, or the text "infinity".
[[nodiscard]] Codec<double> number_or_infinity(std::string unit, Range range);
[[nodiscard]] Codec<int> integer(int min, int max);
/// Whole numbers that doubles can carry: 0 … 2^53 - 1.
[[nodiscard]] Codec<std::uint64_t> counter();
[[nodiscard]] Codec<bool> flag();
[[nodiscard]] Codec<std::string> text(std::size_t min_bytes, std::size_t max_bytes);
[[nodiscard]] Codec<std::string> one_of(std::vector<std::string> names);

/// What the third component is where a 2D scene gives two numbers.
enum class Third { kZero, kLargest };
/// Three numbers, or two in a 2D scene.
[[nodiscard]] Codec<Vec3> vector(std::string unit, Range range, Third third = Third::kZero);
/// A vector that gives a direction: not zero.
[[nodiscard]] Codec<Vec3> direction();
[[nodiscard]] Codec<Eigen::Vector2d> pair_of_numbers(std::string unit, Range range);
/// Three rows of three numbers.
[[nodiscard]] Codec<Mat3> matrix(std::string unit, Range range);
[[nodiscard]] Codec<std::array<bool, 3>> three_flags();
/// sRGB, each part from 0 to 1.
[[nodiscard]] Codec<std::array<double, 3>> color();

/// Enumerators by name.
template <class E>
Codec<E> enumeration(std::vector<std::pair<std::string, E>> entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(entry.first);
  const Codec<std::string> by_name = one_of(names);
  Codec<E> codec;
  codec.schema = by_name.schema;
  codec.allowed = by_name.allowed;
  codec.read = [entries, by_name](const Value& value, E& out, const Place& place) {
    std::string name;
    if (!by_name.read(value, name, place)) return false;
    for (const auto& entry : entries) {
      if (entry.first == name) out = entry.second;
    }
    return true;
  };
  codec.write = [entries](const E& e) {
    for (const auto& entry : entries) {
      if (entry.second == e) return Value(entry.first);
    }
    return Value();
  };
  return codec;
}

template <class V>
Codec<std::vector<V>> list_of(Codec<V> element, std::size_t min, std::size_t max, const std::string& what) {
  Codec<std::vector<V>> codec;
  codec.unit = element.unit;
  codec.allowed = "a list of " + std::to_string(min) + " to " + std::to_string(max) + " " + what;
  codec.schema = {{"type", "array"},
                  {"items", element.schema},
                  {"minItems", static_cast<std::int64_t>(min)},
                  {"maxItems", static_cast<std::int64_t>(max)}};
  codec.read = [element, min, max, allowed = codec.allowed](const Value& value, std::vector<V>& out,
                                                            const Place& place) {
    const Array* array = value.array();
    if (array == nullptr) return place.refuse(value, allowed, "This must be a list.");
    if (array->size() < min || array->size() > max) {
      return place.refuse(value, allowed, "The list has " + std::to_string(array->size()) + " entries.");
    }
    bool good = true;
    out.assign(array->size(), V{});
    for (std::size_t i = 0; i < array->size(); ++i)
      good = element.read((*array)[i], out[i], place.at(i)) && good;
    return good;
  };
  codec.write = [element](const std::vector<V>& list) {
    Array array;
    for (const V& v : list) array.push_back(element.write(v));
    return Value(std::move(array));
  };
  return codec;
}

/// An object described by a table that outlives the codec.
template <class T>
Codec<T> object_of(const Table<T>& table) {
  Codec<T> codec;
  codec.allowed = "an object, see " + table.info().title;
  codec.schema = object_schema(table.info());
  codec.read = [&table](const Value& value, T& out, const Place& place) {
    return table.read(value, out, place);
  };
  codec.write = [&table](const T& source) {
    Object object;
    table.write_fields(source, object);
    return Value(std::move(object));
  };
  return codec;
}

/// An object that is there or not. Left out, and null, stand for "off": null lets a size or an override take
/// it away.
template <class S, class T>
Field<S> switchable(const char* name, std::optional<T> S::*member, const Table<T>& table,
                    const char* meaning) {
  Codec<std::optional<T>> codec;
  const Codec<T> given = object_of(table);
  codec.allowed = given.allowed + ", or null";
  codec.schema = {{"anyOf", Array{given.schema, Object{{"type", "null"}}}}};
  codec.read = [given](const Value& value, std::optional<T>& out, const Place& place) {
    out.reset();
    return std::holds_alternative<std::nullptr_t>(value.data) || given.read(value, out.emplace(), place);
  };
  codec.write = [given](const std::optional<T>& t) { return t ? given.write(*t) : Value(); };
  Field<S> out = optional<S>(name, member, codec, meaning, "off");
  out.write = [given, member](const S& source) {
    return source.*member ? std::optional<Value>(given.write(*(source.*member))) : std::nullopt;
  };
  return out;
}

}  // namespace lather::descriptor
