#include "sim/shape/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

namespace lather {
namespace {

static_assert(std::endian::native == std::endian::little,
              "binary PLY is read and written as memory holds it");

enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::optional<Scalar> scalar_named(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, Scalar>, 16> kNames = {
      {{"char", Scalar::kInt8},
       {"int8", Scalar::kInt8},
       {"uchar", Scalar::kUint8},
       {"uint8", Scalar::kUint8},
       {"short", Scalar::kInt16},
       {"int16", Scalar::kInt16},
       {"ushort", Scalar::kUint16},
       {"uint16", Scalar::kUint16},
       {"int", Scalar::kInt32},
       {"int32", Scalar::kInt32},
       {"uint", Scalar::kUint32},
       {"uint32", Scalar::kUint32},
       {"float", Scalar::kFloat},
       {"float32", Scalar::kFloat},
       {"double", Scalar::kDouble},
       {"float64", Scalar::kDouble}}};
  for (const auto& [known, type] : kNames)
    if (known == name) return type;
  return std::nullopt;
}

struct Property {
  Scalar type = Scalar::kFloat;
  Scalar count = Scalar::kUint8;  // of a list
};

/// Takes numbers off the body, as text or as memory.
class Body {
 public:
  Body(std::string_view bytes, bool text) : rest_(bytes), text_(text) {}

  /// None at the end of the bytes, or where a word is no number.
  std::optional<double> take(Scalar type) {
    if (text_) return take_word();
    switch (type) {
      case Scalar::kInt8:
        return take_as<std::int8_t>();
      case Scalar::kUint8:
        return take_as<std::uint8_t>();
      case Scalar::kInt16:
        return take_as<std::int16_t>();
      case Scalar::kUint16:
        return take_as<std::uint16_t>();
      case Scalar::kInt32:
        return take_as<std::int32_t>();
      case Scalar::kUint32:
        return take_as<std::uint32_t>();
      case Scalar::kFloat:
        return take_as<float>();
      case Scalar::kDouble:
        return take_as<double>();
    }
    return std::nullopt;
  }

  /// A number takes a byte at least, a word and its space two.
  [[nodiscard]] std::size_t most_numbers() const { return text_ ? rest_.size() / 2 + 1 : rest_.size(); }

 private:
  template <class T>
  std::optional<double> take_as() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, rest_.data(), sizeof value);
    rest_.remove_prefix(sizeof value);
    return static_cast<double>(value);
  }

  std::optional<double> take_word() {
    const std::size_t start = rest_.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) return std::nullopt;
    rest_.remove_prefix(start);
    const std::size_t size = std::min(rest_.find_first_of(" \t\r\n"), rest_.size());
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + size, value);
    if (error != std::errc{} || end != rest_.data() + size) return std::nullopt;
    rest_.remove_prefix(size);
    return value;
  }

  std::string_view rest_;
  bool text_;
};

class PlyReader {
 public:
  explicit PlyReader(std::string_view bytes) : rest_(bytes) {}

  PlyFile read() {
    read_header();
    Body body(rest_, text_);
    for (std::size_t e = 0; e < file_.elements.size(); ++e)
      read_element(body, file_.elements[e], properties_[e]);
    return std::move(file_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error("header line " + std::to_string(line_) + ": " + what);
  }

  /// Words of the next line of the header, at most six.
  std::vector<std::string_view> next_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos || line_ > 1000) refuse("the header has no end_header.");
    ++line_;
    full_line_ = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (!full_line_.empty() && full_line_.back() == '\r') full_line_.remove_suffix(1);
    std::vector<std::string_view> words;
    std::string_view left = full_line_;
    while (words.size() < 6) {
      const std::size_t start = left.find_first_not_of(" \t");
      if (start == std::string_view::npos) break;
      left.remove_prefix(start);
      words.push_back(left.substr(0, left.find_first_of(" \t")));
      left.remove_prefix(words.back().size());
    }
    return words;
  }

  void read_header() {
    if (const auto words = next_line(); words.size() != 1 || words[0] != "ply")
      refuse("the file does not start with \"ply\".");
    bool formatted = false;
    while (true) {
      const std::vector<std::string_view> words = next_line();
      if (words.empty() || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "comment") {
        file_.comments.emplace_back(full_line_.substr(std::min<std::size_t>(full_line_.size(), 8)));
      } else if (words[0] == "format" && words.size() >= 2) {
        read_format(words[1]);
        formatted = true;
      } else if (words[0] == "element" && words.size() == 3) {
        add_element(words);
      } else if (words[0] == "property" && !file_.elements.empty()) {
        add_property(words);
      } else {
        refuse("\"" + std::string(full_line_.substr(0, 60)) + "\" is not understood.");
      }
    }
    if (!formatted) refuse("the header names no format.");
  }

  void read_format(std::string_view name) {
    text_ = name == "ascii";
    if (!text_ && name != "binary_little_endian")
      refuse("the format \"" + std::string(name) +
             "\" is not read. Save the file as ascii or binary_little_endian.");
  }

  void add_element(const std::vector<std::string_view>& words) {
    PlyElement element;
    element.name = words[1];
    const auto [end, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.rows);
    if (error != std::errc{} || end != words[2].data() + words[2].size())
      refuse("\"" + std::string(words[2]) + "\" is no count.");
    file_.elements.push_back(std::move(element));
    properties_.emplace_back();
  }

  void add_property(const std::vector<std::string_view>& words) {
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) refuse("\"" + std::string(full_line_) + "\" is no property.");
    const std::optional<Scalar> type = scalar_named(words[list ? 3 : 1]);
    const std::optional<Scalar> count = scalar_named(words[list ? 2 : 1]);
    if (!type || !count) refuse("\"" + std::string(full_line_) + "\" names a type that is not known.");
    PlyColumn column;
    column.name = words.back();
    column.list = list;
    file_.elements.back().columns.push_back(std::move(column));
    properties_.back().push_back({*type, *count});
  }

  static void read_element(Body& body, PlyElement& element, const std::vector<Property>& properties) {
    if (element.columns.empty()) return;
    const std::size_t reserve = std::min(element.rows, body.most_numbers());
    for (PlyColumn& column : element.columns)
      column.list ? column.ends.reserve(reserve) : column.values.reserve(reserve);
    for (std::size_t row = 0; row < element.rows; ++row)
      for (std::size_t c = 0; c < properties.size(); ++c) {
        if (read_value(body, element.columns[c], properties[c])) continue;
        throw std::runtime_error("element " + element.name + ", row " + std::to_string(row + 1) + ": " +
                                 element.columns[c].name +
                                 " is missing or no number; the file is cut short or damaged.");
      }
  }

  static bool read_value(Body& body, PlyColumn& column, const Property& property) {
    double count = 1;
    if (column.list) {
      const std::optional<double> given = body.take(property.count);
      if (!given || !(*given >= 0) || *given > static_cast<double>(body.most_numbers())) return false;
      count = *given;
    }
    for (double i = 0; i < count; ++i) {
      const std::optional<double> value = body.take(property.type);
      if (!value) return false;
      column.values.push_back(*value);
    }
    if (column.list) column.ends.push_back(static_cast<std::uint32_t>(column.values.size()));
    return true;
  }

  std::string_view rest_, full_line_;
  int line_ = 0;
  bool text_ = false;
  PlyFile file_;
  std::vector<std::vector<Property>> properties_;  // by element
};

template <class T>
const T* find_named(const std::vector<T>& all, std::string_view name) {
  const auto at = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.name == name; });
  return at == all.end() ? nullptr : &*at;
}

}  // namespace

const PlyColumn* PlyElement::find(std::string_view column) const {
  return find_named(columns, column);
}

const PlyElement* PlyFile::find(std::string_view element) const {
  return find_named(elements, element);
}

PlyFile read_ply(std::string_view bytes) {
  return PlyReader(bytes).read();
}

}  // namespace lather
