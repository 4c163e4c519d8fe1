#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/scene/value.h"

namespace lather {
namespace {

using Json = nlohmann::json;

/// Bytes beyond ASCII as \xHH: an error about invalid UTF-8 must be valid UTF-8 itself.
std::string printable(std::string_view text) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      out += c;
    } else {
      out += {'\\', 'x', kDigits[byte >> 4], kDigits[byte & 15]};
    }
  }
  return out;
}

/// "[json.exception.parse_error.101] parse error at …" without the library's tag.
std::string without_tag(const std::string& what) {
  const std::size_t end = what.find("] ");
  return printable(what.front() == '[' && end != std::string::npos ? what.substr(end + 2) : what);
}

/// Builds the value while it guards: depth, count, lengths, keys given twice. The first breach ends the
/// reading.
class Builder : public nlohmann::json_sax<Json> {
 public:
  Value root;
  std::vector<Problem> problems;

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(std::int64_t{value}); }
  bool number_unsigned(number_unsigned_t value) override {
    if (value > static_cast<number_unsigned_t>(INT64_MAX)) return put(static_cast<double>(value));
    return put(static_cast<std::int64_t>(value));
  }
  bool number_float(number_float_t value, const string_t& text) override {
    if (!std::isfinite(value)) return refuse(printable(text), "a finite number", "The number is too large.");
    return put(value);
  }
  bool string(string_t& value) override { return fits(value) && put(std::move(value)); }
  bool binary(binary_t& /*value*/) override { return refuse("", "JSON text", "Binary values are not JSON."); }
  bool start_object(std::size_t /*elements*/) override { return open(Object{}); }
  bool start_array(std::size_t /*elements*/) override { return open(Array{}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    if (!fits(name)) return false;
    Object& object = *open_.back()->object();
    const auto same = [&](const auto& member) { return member.first == name; };
    if (std::any_of(object.begin(), object.end(), same)) {
      problems.push_back({container() + pointer_token(name), "", "every key once",
                          "The key \"" + name + "\" is given twice; keep one of them."});
      return false;
    }
    object.emplace_back(std::move(name), Value());
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last,
                   const nlohmann::detail::exception& error) override {
    problems.push_back({"", printable(last).substr(0, 80), "valid JSON in UTF-8",
                        "This is not valid JSON, at byte " + std::to_string(position) + ": " +
                            without_tag(error.what()) + "."});
    return false;
  }

 private:
  /// Pointer to the open container that is read now.
  [[nodiscard]] std::string container() const {
    std::string pointer;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const Array* array = open_[i]->array();
      pointer += pointer_token(array != nullptr ? std::to_string(array->size() - 1)
                                                : open_[i]->object()->back().first);
    }
    return pointer;
  }

  /// Pointer to the value that comes next.
  [[nodiscard]] std::string where() const {
    if (open_.empty()) return "";
    if (const Array* array = open_.back()->array())
      return container() + pointer_token(std::to_string(array->size()));
    const Object* object = open_.back()->object();
    return container() + (object->empty() ? "" : pointer_token(object->back().first));
  }

  bool refuse(std::string value, std::string allowed, std::string message) {
    problems.push_back({where(), std::move(value), std::move(allowed), std::move(message)});
    return false;
  }

  bool fits(const std::string& text) {
    if (text.size() <= kMaxJsonString) return true;
    return refuse(text.substr(0, 40) + "…", "at most 65536 bytes", "The text is too long.");
  }

  /// Where the next value belongs.
  Value& slot() {
    if (open_.empty()) return root;
    if (Array* array = open_.back()->array()) return array->emplace_back();
    return open_.back()->object()->back().second;
  }

  template <class T>
  bool put(T value) {
    if (++count_ > kMaxJsonValues)
      return refuse("", "at most 200000 values", "The document holds too many values.");
    slot().data = std::move(value);
    return true;
  }

  template <class T>
  bool open(T container) {
    if (open_.size() >= kMaxJsonDepth)
      return refuse("", "at most 32 levels", "The document is nested too deeply.");
    if (++count_ > kMaxJsonValues)
      return refuse("", "at most 200000 values", "The document holds too many values.");
    Value& value = slot();
    value.data = std::move(container);
    open_.push_back(&value);  // stays put: a parent takes no further element before this one is closed
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Value*> open_;
  std::size_t count_ = 0;
};

/// The fewest digits that read back as the same number, with an exponent only for very small and large ones.
std::string number(double value) {
  if (value == 0) return "0";  // no negative zero
  const double size = std::abs(value);
  char text[32];
  const auto end = size >= 1e-4 && size < 1e7
                       ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr
                       : std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string quoted(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

class Writer {
 public:
  explicit Writer(int indent) : indent_(indent) {}

  void write(const Value& value, int depth) {
    std::visit([&](const auto& v) { put(v, depth); }, value.data);
  }

  std::string out;

 private:
  void put(std::nullptr_t, int) { out += "null"; }
  void put(bool v, int) { out += v ? "true" : "false"; }
  void put(std::int64_t v, int) { out += std::to_string(v); }
  void put(double v, int) { out += number(v); }
  void put(const std::string& v, int) { out += quoted(v); }
  void put(const Array& v, int depth) {
    const bool flat = indent_ < 0 || std::none_of(v.begin(), v.end(), [](const Value& e) {
                        return e.array() != nullptr || e.object() != nullptr;
                      });
    out += '[';
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (i > 0) out += flat && indent_ >= 0 ? ", " : ",";
      if (!flat) line(depth + 1);
      write(v[i], depth + 1);
    }
    if (!flat) line(depth);
    out += ']';
  }
  void put(const Object& v, int depth) {
    out += '{';
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (i > 0) out += ',';
      line(depth + 1);
      out += quoted(v[i].first) + (indent_ < 0 ? ":" : ": ");
      write(v[i].second, depth + 1);
    }
    if (!v.empty()) line(depth);
    out += '}';
  }
  void line(int depth) {
    if (indent_ >= 0) out += '\n' + std::string(static_cast<std::size_t>(indent_ * depth), ' ');
  }

  int indent_;
};

}  // namespace

Value parse_json(std::string_view text) {
  Builder builder;
  const bool whole = Json::sax_parse(text.begin(), text.end(), &builder);
  if (!whole || !builder.problems.empty()) throw InputError(std::move(builder.problems));
  return std::move(builder.root);
}

std::string write_json(const Value& value, int indent) {
  Writer writer(indent);
  writer.write(value, 0);
  return std::move(writer.out);
}

}  // namespace lather
