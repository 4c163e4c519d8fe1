#pragma once

#include "sim/scene/codecs.h"

/// Objects whose key "type" says which alternative of a variant they are: shapes, motions.
namespace lather::descriptor {

template <class Variant>
struct Alternative {
  std::string type;
  TableInfo info;
  std::function<bool(const Variant&)> holds;
  std::function<bool(const Value&, Variant&, const Place&)> read;
  std::function<void(const Variant&, Object&)> write;
};

template <class Variant, class T>
Alternative<Variant> alternative(std::string type, Table<T> table) {
  auto shared = std::make_shared<const Table<T>>(std::move(table));
  return {std::move(type), shared->info(), [](const Variant& v) { return std::holds_alternative<T>(v); },
          [shared](const Value& value, Variant& out, const Place& place) {
            T read = shared->prototype();
            if (!shared->read_fields(value, read, place)) return false;
            out = std::move(read);
            return true;
          },
          [shared](const Variant& v, Object& out) { shared->write_fields(std::get<T>(v), out); }};
}

template <class Variant>
class Tagged {
 public:
  /// `common` are fields that every alternative takes beside its own.
  Tagged(std::vector<Alternative<Variant>> alternatives, std::vector<FieldInfo> common)
      : alternatives_(std::move(alternatives)), common_(std::move(common)) {
    std::vector<std::string> types;
    for (const auto& a : alternatives_) types.push_back(a.type);
    type_ = one_of(types);
  }

  bool read(const Value& value, Variant& out, const Place& place) const {
    if (value.object() == nullptr)
      return place.refuse(value, "an object", "This must be an object with a \"type\".");
    const Value* type = value.find("type");
    if (type == nullptr) return place.at("type").refuse(nullptr, type_.allowed, "\"type\" is missing.");
    std::string name;
    if (!type_.read(*type, name, place.at("type"))) return false;
    for (const auto& a : alternatives_) {
      if (a.type != name) continue;
      std::vector<std::string> known = {"type"};
      for (const FieldInfo& field : a.info.fields) known.push_back(field.name);
      for (const FieldInfo& field : common_) known.push_back(field.name);
      refuse_unknown_keys(*value.object(), known, place);
      return a.read(value, out, place);
    }
    return false;
  }

  /// The first alternative that holds `v` writes it.
  [[nodiscard]] Object write(const Variant& v) const {
    Object out;
    for (const auto& a : alternatives_) {
      if (!a.holds(v)) continue;
      out.emplace_back("type", a.type);
      a.write(v, out);
      break;
    }
    return out;
  }

  [[nodiscard]] Object schema() const {
    Array any;
    for (const auto& a : alternatives_) {
      std::vector<FieldInfo> more = common_;
      more.push_back(
          {"type", "which " + a.info.title, Presence::kRequired, "", "", {{"const", a.type}}, {}, ""});
      any.emplace_back(object_schema(a.info, more));
    }
    return {{"oneOf", std::move(any)}};
  }

  [[nodiscard]] const std::vector<Alternative<Variant>>& alternatives() const { return alternatives_; }
  [[nodiscard]] const std::vector<FieldInfo>& common() const { return common_; }

 private:
  std::vector<Alternative<Variant>> alternatives_;
  std::vector<FieldInfo> common_;
  Codec<std::string> type_;
};

}  // namespace lather::descriptor
