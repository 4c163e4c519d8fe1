#include "sim/scene/descriptor.h"

#include <algorithm>
#include <numeric>

namespace lather::descriptor {
namespace {

constexpr std::size_t kShownBytes = 80;

/// The value as the user wrote it, cut short without cutting a UTF-8 character in two.
std::string shown(const Value& value) {
  std::string text = write_json(value);
  if (text.size() <= kShownBytes) return text;
  std::size_t end = kShownBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j + 1] + 1, row[j] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

Place Place::at(std::string_view key) const {
  Place inner = *this;
  inner.pointer_ += pointer_token(key);
  return inner;
}

Place Place::at(std::size_t index) const {
  Place inner = *this;
  inner.pointer_ += '/' + std::to_string(index);
  return inner;
}

bool Place::refuse(const Value* value, const std::string& allowed, const std::string& message) const {
  reading_->problems.push_back({pointer_, value != nullptr ? shown(*value) : "", allowed, message});
  return false;
}

Object field_schema(const FieldInfo& field) {
  Object schema = field.schema;
  schema.emplace_back("description", field.words);
  if (field.default_value) schema.emplace_back("default", *field.default_value);
  if (!field.unit.empty()) schema.emplace_back("x-unit", field.unit);
  return schema;
}

Object object_schema(const TableInfo& table, const std::vector<FieldInfo>& more) {
  Object properties;
  Array required;
  std::vector<FieldInfo> fields = table.fields;
  fields.insert(fields.end(), more.begin(), more.end());
  for (const FieldInfo& field : fields) {
    properties.emplace_back(field.name, field_schema(field));
    if (field.presence == Presence::kRequired) required.emplace_back(field.name);
  }
  Object schema = {{"type", "object"}, {"properties", std::move(properties)}};
  if (!required.empty()) schema.emplace_back("required", std::move(required));
  schema.emplace_back("additionalProperties", false);
  return schema;
}

void refuse_unknown_keys(const Object& object, const std::vector<std::string>& known, const Place& place) {
  for (const auto& [key, value] : object) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string near = nearest_name(key, known);
    const std::string advice = near.empty() ? "Take it out." : "Did you mean \"" + near + "\"?";
    place.at(key).refuse(value, listed(known),
                         "The key \"" + key.substr(0, 80) + "\" is not known here. " + advice);
  }
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  if (word.size() > 64) return "";
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < least) {
      least = distance;
      best = name;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
    out += '"' + names[i] + '"';
  }
  return out;
}

}  // namespace lather::descriptor
