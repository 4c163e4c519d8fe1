#pragma once

namespace lather {

/// Interior voids are searched for with a byte a cell, in a box of at most this many cells.
inline constexpr double kMostSearchedCells = 268'435'456;

}  // namespace lather
