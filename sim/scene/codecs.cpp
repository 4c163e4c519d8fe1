#include "sim/scene/codecs.h"

#include <algorithm>
#include <cmath>

namespace lather::descriptor {
namespace {

constexpr std::int64_t kLargestCounter = (std::int64_t{1} << 53) - 1;

std::string shortest(double x) {
  return write_json(Value(x));
}

/// The number that `value` is; none for any other kind.
std::optional<double> as_number(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  return std::nullopt;
}

/// The whole number that `value` is: 8 and 8.0, not 8.5, not true.
std::optional<std::int64_t> as_integer(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return *whole;
  const auto* real = std::get_if<double>(&value.data);
  const bool is_whole = real != nullptr && std::trunc(*real) == *real &&
                        std::abs(*real) <= static_cast<double>(kLargestCounter);
  if (!is_whole) return std::nullopt;
  return static_cast<std::int64_t>(*real);
}

bool read_number(const Value& value, double& out, const Range& range, const std::string& allowed,
                 const Place& place) {
  const std::optional<double> x = as_number(value);
  if (!x) return place.refuse(value, allowed, "This must be a number.");
  if (!range.holds(*x)) return place.refuse(value, allowed, "The number is out of range.");
  out = *x;
  return true;
}

Object number_schema(const Range& range) {
  Object schema = {{"type", "number"}};
  range.add_to(schema);
  return schema;
}

Object list_schema(Object items, std::int64_t min, std::int64_t max) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", min}, {"maxItems", max}};
}

template <class I>
Codec<I> whole_number(std::int64_t min, std::int64_t max) {
  Codec<I> codec;
  codec.allowed = "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
  codec.schema = {{"type", "integer"}, {"minimum", min}, {"maximum", max}};
  codec.read = [min, max, allowed = codec.allowed](const Value& value, I& out, const Place& place) {
    const std::optional<std::int64_t> n = as_integer(value);
    if (!n) return place.refuse(value, allowed, "This must be a whole number.");
    if (*n < min || *n > max) return place.refuse(value, allowed, "The number is out of range.");
    out = static_cast<I>(*n);
    return true;
  };
  codec.write = [](const I& n) { return Value(static_cast<std::int64_t>(n)); };
  return codec;
}

/// A fixed number of elements in a std::array or Eigen vector.
template <class A, class V>
Codec<A> fixed_list(std::size_t count, Codec<V> element, const std::string& what) {
  Codec<A> codec;
  codec.unit = element.unit;
  codec.allowed = std::to_string(count) + " " + what;
  codec.schema =
      list_schema(element.schema, static_cast<std::int64_t>(count), static_cast<std::int64_t>(count));
  codec.read = [count, element, allowed = codec.allowed](const Value& value, A& out, const Place& place) {
    const Array* array = value.array();
    if (array == nullptr || array->size() != count) {
      return place.refuse(value, allowed, "This must be a list of " + std::to_string(count) + ".");
    }
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) {
      V v{};
      good = element.read((*array)[i], v, place.at(i)) && good;
      out[static_cast<decltype(out.size())>(i)] = v;
    }
    return good;
  };
  codec.write = [count, element](const A& a) {
    Array array;
    for (std::size_t i = 0; i < count; ++i)
      array.push_back(element.write(a[static_cast<decltype(a.size())>(i)]));
    return Value(std::move(array));
  };
  return codec;
}

}  // namespace

bool Range::holds(double x) const {
  return (open_min ? x > min : x >= min) && (open_max ? x < max : x <= max);
}

std::string Range::words(const std::string& unit) const {
  const std::string suffix = unit.empty() || unit == "1" ? "" : " " + unit;
  if (min == -kInfinity && max == kInfinity) return "any number" + suffix;
  return "from " + shortest(min) + (open_min ? " (not itself)" : "") + " to " + shortest(max) +
         (open_max ? " (not itself)" : "") + suffix;
}

void Range::add_to(Object& schema) const {
  if (min != -kInfinity) schema.emplace_back(open_min ? "exclusiveMinimum" : "minimum", min);
  if (max != kInfinity) schema.emplace_back(open_max ? "exclusiveMaximum" : "maximum", max);
}

Codec<double> number(std::string unit, Range range) {
  Codec<double> codec;
  codec.allowed = range.words(unit);
  codec.unit = std::move(unit);
  codec.schema = number_schema(range);
  codec.read = [range, allowed = codec.allowed](const Value& value, double& out, const Place& place) {
    return read_number(value, out, range, allowed, place);
  };
  codec.write = [](const double& x) { return Value(x); };
  return codec;
}

Codec<double> number_or_infinity(std::string unit, Range range) {
  Codec<double> codec = number(std::move(unit), range);
  codec.allowed += ", or \"infinity\"";
  codec.schema = {{"anyOf", Array{number_schema(range), Object{{"const", "infinity"}}}}};
  codec.read = [range, allowed = codec.allowed](const Value& value, double& out, const Place& place) {
    const std::string* word = value.text();
    if (word == nullptr) return read_number(value, out, range, allowed, place);
    if (*word != "infinity")
      return place.refuse(value, allowed, "The only word allowed here is \"infinity\".");
    out = kInfinity;
    return true;
  };
  codec.write = [](const double& x) { return std::isinf(x) ? Value("infinity") : Value(x); };
  return codec;
}

Codec<int> integer(int min, int max) {
  return whole_number<int>(min, max);
}

Codec<std::uint64_t> counter() {
  return whole_number<std::uint64_t>(0, kLargestCounter);
}

Codec<bool> flag() {
  Codec<bool> codec;
  codec.allowed = "true or false";
  codec.schema = {{"type", "boolean"}};
  codec.read = [](const Value& value, bool& out, const Place& place) {
    const bool* given = std::get_if<bool>(&value.data);
    if (given == nullptr) return place.refuse(value, "true or false", "This must be true or false.");
    out = *given;
    return true;
  };
  codec.write = [](const bool& b) { return Value(b); };
  return codec;
}

Codec<std::string> text(std::size_t min_bytes, std::size_t max_bytes) {
  Codec<std::string> codec;
  codec.allowed = "text of " + std::to_string(min_bytes) + " to " + std::to_string(max_bytes) + " bytes";
  codec.schema = {{"type", "string"},
                  {"minLength", static_cast<std::int64_t>(min_bytes)},
                  {"maxLength", static_cast<std::int64_t>(max_bytes)}};
  codec.read = [=, allowed = codec.allowed](const Value& value, std::string& out, const Place& place) {
    const std::string* given = value.text();
    if (given == nullptr) return place.refuse(value, allowed, "This must be text.");
    if (given->size() < min_bytes) return place.refuse(value, allowed, "The text is too short.");
    if (given->size() > max_bytes) return place.refuse(value, allowed, "The text is too long.");
    out = *given;
    return true;
  };
  codec.write = [](const std::string& s) { return Value(s); };
  return codec;
}

Codec<std::string> one_of(std::vector<std::string> names) {
  Codec<std::string> codec;
  codec.allowed = listed(names);
  codec.schema = {{"type", "string"}, {"enum", Array(names.begin(), names.end())}};
  codec.read = [names, allowed = codec.allowed](const Value& value, std::string& out, const Place& place) {
    const std::string* given = value.text();
    if (given == nullptr) return place.refuse(value, allowed, "This must be one of the names.");
    if (std::find(names.begin(), names.end(), *given) == names.end()) {
      const std::string near = nearest_name(*given, names);
      return place.refuse(value, allowed,
                          "The name is not known." + (near.empty() ? "" : " Did you mean \"" + near + "\"?"));
    }
    out = *given;
    return true;
  };
  codec.write = [](const std::string& s) { return Value(s); };
  return codec;
}

Codec<Vec3> vector(std::string unit, Range range, Third third) {
  Codec<Vec3> codec;
  const Codec<double> component = number(unit, range);
  codec.allowed = "3 numbers (2 in a 2D scene), each " + component.allowed;
  codec.unit = std::move(unit);
  codec.schema = list_schema(component.schema, 2, 3);
  codec.read = [component, third, allowed = codec.allowed](const Value& value, Vec3& out,
                                                           const Place& place) {
    const Array* array = value.array();
    const bool fits =
        array != nullptr && (array->size() == 3 || (array->size() == 2 && place.dimension() == 2));
    if (!fits) return place.refuse(value, allowed, "This must be a list of numbers, one an axis.");
    Vec3 read = Vec3::Zero();
    bool good = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
      good = component.read((*array)[i], read[static_cast<Eigen::Index>(i)], place.at(i)) && good;
    }
    if (array->size() == 2 && third == Third::kLargest) read.z() = std::max(read.x(), read.y());
    if (good) out = read;
    return good;
  };
  codec.write = [](const Vec3& v) { return Value(Array{v.x(), v.y(), v.z()}); };
  return codec;
}

Codec<Vec3> direction() {
  Codec<Vec3> codec = vector("", from_to(-1e6, 1e6));
  codec.allowed += ", not all zero";
  codec.read = [read = codec.read, allowed = codec.allowed](const Value& value, Vec3& out,
                                                            const Place& place) {
    Vec3 given = out;
    if (!read(value, given, place)) return false;
    if (given.norm() < 1e-9) return place.refuse(value, allowed, "A direction cannot be zero.");
    out = given;
    return true;
  };
  return codec;
}

Codec<Eigen::Vector2d> pair_of_numbers(std::string unit, Range range) {
  const Codec<double> component = number(std::move(unit), range);
  return fixed_list<Eigen::Vector2d>(2, component, "numbers, each " + component.allowed);
}

Codec<Mat3> matrix(std::string unit, Range range) {
  const Codec<double> entry = number(std::move(unit), range);
  const Codec<Vec3> row = fixed_list<Vec3>(3, entry, "numbers, each " + entry.allowed);
  Codec<Mat3> codec;
  codec.unit = entry.unit;
  codec.allowed = "3 rows of " + row.allowed;
  codec.schema = list_schema(row.schema, 3, 3);
  codec.read = [row, allowed = codec.allowed](const Value& value, Mat3& out, const Place& place) {
    const Array* array = value.array();
    if (array == nullptr || array->size() != 3)
      return place.refuse(value, allowed, "This must be a list of 3 rows.");
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 read = Vec3::Zero();
      good = row.read((*array)[i], read, place.at(i)) && good;
      out.row(static_cast<Eigen::Index>(i)) = read;
    }
    return good;
  };
  codec.write = [row](const Mat3& m) {
    Array rows;
    for (Eigen::Index i = 0; i < 3; ++i) rows.push_back(row.write(m.row(i)));
    return Value(std::move(rows));
  };
  return codec;
}

Codec<std::array<bool, 3>> three_flags() {
  return fixed_list<std::array<bool, 3>>(3, flag(), "of true or false, one an axis");
}

Codec<std::array<double, 3>> color() {
  return fixed_list<std::array<double, 3>>(3, number("", from_to(0, 1)),
                                           "numbers (red, green, blue), each from 0 to 1");
}

}  // namespace lather::descriptor
