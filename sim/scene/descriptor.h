#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/value.h"

namespace lather {
class MeshLibrary;
}

/// Descriptors: one table per struct says of every parameter its name, unit, range, default and meaning.
/// Reading with errors, writing, the JSON Schema and the reference are all made from these tables and from
/// nothing else.
namespace lather::descriptor {

/// What one reading of a document shares: its dimension, the meshes it names and the problems found so far.
struct Reading {
  int dimension = 3;
  MeshLibrary* meshes = nullptr;
  std::vector<Problem> problems;
};

/// Where a value stands in the document, and what is known about it there.
class Place {
 public:
  explicit Place(Reading& reading) : reading_(&reading) {}
  [[nodiscard]] Place at(std::string_view key) const;
  [[nodiscard]] Place at(std::size_t index) const;
  [[nodiscard]] int dimension() const { return reading_->dimension; }
  [[nodiscard]] MeshLibrary& meshes() const { return *reading_->meshes; }

  /// Notes a problem with the value here; returns false, so that a reader can return it.
  bool refuse(const Value* value, const std::string& allowed, const std::string& message) const;
  bool refuse(const Value& value, const std::string& allowed, const std::string& message) const {
    return refuse(&value, allowed, message);
  }

 private:
  Reading* reading_;
  std::string pointer_;
};

/// How a C++ value of type V stands in JSON.
template <class V>
struct Codec {
  std::function<bool(const Value&, V&, const Place&)> read;  ///< false where the value was refused
  std::function<Value(const V&)> write;
  Object schema;        ///< JSON Schema of the value
  std::string unit;     ///< "" where there is none
  std::string allowed;  ///< range or names, in words
};

enum class Presence { kRequired, kOptional };

/// What schema and reference need to know of a field, free of the struct it belongs to.
struct FieldInfo {
  std::string name;
  std::string words;  ///< one line: what it means
  Presence presence = Presence::kOptional;
  std::string unit;
  std::string allowed;
  Object schema;
  std::optional<Value> default_value;  ///< none: required, or left out by default
  std::string default_words;           ///< instead of the value, where it depends on others
};

/// A table as schema and reference see it.
struct TableInfo {
  std::string title;
  std::string words;
  std::vector<FieldInfo> fields;
};

/// The JSON Schema of an object with these fields; `more` adds fields of another table to the same object.
[[nodiscard]] Object object_schema(const TableInfo& table, const std::vector<FieldInfo>& more = {});
[[nodiscard]] Object field_schema(const FieldInfo& field);

/// Notes every key of `object` that is in none of `known`, with the nearest known name as a suggestion.
void refuse_unknown_keys(const Object& object, const std::vector<std::string>& known, const Place& place);

/// The name in `names` nearest to `word` by edit distance, "" where none is near.
[[nodiscard]] std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "a", "b" or "c".
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

template <class T>
struct Field {
  FieldInfo info;
  std::function<bool(const Value&, T&, const Place&)> read;
  std::function<std::optional<Value>(const T&)> write;  ///< none: the key is left out
};

template <class T>
class Table {
 public:
  using Check = std::function<void(const Value&, T&, const Place&)>;

  /// `prototype` holds the defaults. `check` looks at the whole object once its fields are read.
  Table(std::string title, std::string words, std::vector<Field<T>> fields, T prototype = {},
        Check check = {})
      : prototype_(std::move(prototype)), fields_(std::move(fields)), check_(std::move(check)) {
    info_ = {std::move(title), std::move(words), {}};
    for (Field<T>& field : fields_) {
      if (field.info.presence == Presence::kOptional && field.info.default_words.empty()) {
        field.info.default_value = field.write(prototype_);
      }
      info_.fields.push_back(field.info);
    }
  }

  [[nodiscard]] const TableInfo& info() const { return info_; }
  [[nodiscard]] const T& prototype() const { return prototype_; }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const FieldInfo& field : info_.fields) out.push_back(field.name);
    return out;
  }

  /// Reads the fields that stand in `value`, an object, into `target`; other keys are not looked at.
  /// With `all_optional` nothing need be given: `target` holds values already.
  bool read_fields(const Value& value, T& target, const Place& place, bool all_optional = false) const {
    bool good = true;
    for (const Field<T>& field : fields_) {
      const Value* given = value.find(field.info.name);
      const Place there = place.at(field.info.name);
      if (given != nullptr) {
        good = field.read(*given, target, there) && good;
      } else if (field.info.presence == Presence::kRequired && !all_optional) {
        good = there.refuse(nullptr, field.info.allowed,
                            "\"" + field.info.name + "\" is missing: " + field.info.words + ".");
      }
    }
    if (good && check_) check_(value, target, place);
    return good;
  }

  /// Reads a whole object: its fields, and no other keys.
  bool read(const Value& value, T& target, const Place& place) const {
    if (value.object() == nullptr) return place.refuse(value, "an object", "This must be an object.");
    refuse_unknown_keys(*value.object(), names(), place);
    return read_fields(value, target, place);
  }

  void write_fields(const T& source, Object& out) const {
    for (const Field<T>& field : fields_) {
      if (std::optional<Value> value = field.write(source))
        out.emplace_back(field.info.name, std::move(*value));
    }
  }

 private:
  T prototype_;
  std::vector<Field<T>> fields_;
  Check check_;
  TableInfo info_;
};

/// A field of T. `access` is a pointer to the member, or a function from T& to the value.
template <class T, class V, class Access>
Field<T> field(Presence presence, std::string name, Access access, Codec<V> codec, std::string words,
               std::string default_words = {}) {
  Field<T> out;
  out.info = {std::move(name), std::move(words), presence, codec.unit,
              codec.allowed,   codec.schema,     {},       std::move(default_words)};
  out.read = [access, read = codec.read](const Value& value, T& target, const Place& place) {
    return read(value, std::invoke(access, target), place);
  };
  out.write = [access, write = codec.write](const T& source) {
    return std::optional<Value>(write(std::invoke(access, source)));
  };
  return out;
}

template <class T, class V, class Access>
Field<T> required(std::string name, Access access, Codec<V> codec, std::string words) {
  return field<T>(Presence::kRequired, std::move(name), access, std::move(codec), std::move(words));
}

template <class T, class V, class Access>
Field<T> optional(std::string name, Access access, Codec<V> codec, std::string words,
                  std::string default_words = {}) {
  return field<T>(Presence::kOptional, std::move(name), access, std::move(codec), std::move(words),
                  std::move(default_words));
}

}  // namespace lather::descriptor
