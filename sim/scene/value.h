#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/error.h"

/// A JSON value as plain data: keys in the order written, whole numbers kept apart from others.
namespace lather {

class Value;
using Array = std::vector<Value>;
using Object = std::vector<std::pair<std::string, Value>>;

class Value {
 public:
  std::variant<std::nullptr_t, bool, std::int64_t, double, std::string, Array, Object> data = nullptr;

  Value() = default;
  template <class T>
  Value(T value) : data(std::move(value)) {}  // NOLINT: a value stands for what it holds
  Value(const char* text) : data(std::string(text)) {}

  [[nodiscard]] const Object* object() const { return std::get_if<Object>(&data); }
  [[nodiscard]] Object* object() { return std::get_if<Object>(&data); }
  [[nodiscard]] const Array* array() const { return std::get_if<Array>(&data); }
  [[nodiscard]] Array* array() { return std::get_if<Array>(&data); }
  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&data); }

  /// The member `key` of an object; null where this is no object or has no such key.
  [[nodiscard]] const Value* find(std::string_view key) const;
  [[nodiscard]] Value* find(std::string_view key);
};

/// Limits of what is read, so that no document can exhaust the machine.
inline constexpr std::size_t kMaxJsonDepth = 32;
inline constexpr std::size_t kMaxJsonValues = 200'000;
inline constexpr std::size_t kMaxJsonString = 65'536;  ///< bytes

/// Reads JSON. Throws InputError: syntax errors with line, column and byte, invalid UTF-8, keys given twice,
/// numbers too large for a double, documents beyond the limits above.
[[nodiscard]] Value parse_json(std::string_view text);

/// JSON text; `indent` spaces a level, or one line where it is negative. Doubles are the shortest text that
/// reads back as the same number; short arrays of numbers stay on one line.
[[nodiscard]] std::string write_json(const Value& value, int indent = -1);

/// RFC 7396: members of `patch` replace those of `target`, null takes them away, objects are merged.
void merge_patch(Value& target, const Value& patch);

/// The value at a JSON pointer (RFC 6901), null where there is none.
[[nodiscard]] const Value* at_pointer(const Value& root, std::string_view pointer);

/// Sets the value at a JSON pointer; makes objects on the way where there are none, takes the field away for
/// null. Throws InputError where the pointer is malformed, or leads into an array element or a scalar that is
/// not there.
void set_at_pointer(Value& root, std::string_view pointer, Value value);

/// `key` as one token of a JSON pointer, with the leading slash.
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace lather
