#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Polygon files (PLY) as tables: text, or binary little endian. Knows nothing of what the columns mean.
namespace lather {

/// One property of an element, a value a row: a column of numbers, or of lists of numbers.
struct PlyColumn {
  std::string name;
  bool list = false;
  std::vector<double> values;       ///< lists one after another
  std::vector<std::uint32_t> ends;  ///< of a list column: where each row's list ends in `values`
};

struct PlyElement {
  std::string name;
  std::size_t rows = 0;
  std::vector<PlyColumn> columns;

  [[nodiscard]] const PlyColumn* find(std::string_view column) const;
};

struct PlyFile {
  std::vector<std::string> comments;
  std::vector<PlyElement> elements;

  [[nodiscard]] const PlyElement* find(std::string_view element) const;
};

/// Throws std::runtime_error with what is wrong and where: the line of the header, or element and row. Rows
/// are counted from 1. Memory is bounded by a small multiple of the bytes.
[[nodiscard]] PlyFile read_ply(std::string_view bytes);

}  // namespace lather
