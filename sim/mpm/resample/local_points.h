#pragma once

#include <vector>

#include "sim/mpm/resample/point_bins.h"

namespace lather::mpm::resample {

/// The points of one block and of the cells next to it, copied together: queries about the cells around one
/// then walk rows of memory. Scratch memory of one thread.
class LocalPoints {
 public:
  explicit LocalPoints(const Lattice& lattice);

  void copy(const PointBins& bins, std::size_t block);

  [[nodiscard]] std::size_t size() const { return x_.size(); }
  [[nodiscard]] const Local& at(std::size_t p) const { return x_[p]; }

  static constexpr int kRows = 9;
  /// The rows of points in the 3^dim cells around cell (i, j, k), the nearest first, in `rows`.
  [[nodiscard]] PointRows around(int i, int j, int k, std::uint32_t (&rows)[kRows][2]) const {
    static constexpr int kOffsets[kRows][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                               {-1, -1}, {-1, 1}, {1, -1}, {1, 1}};
    for (int r = 0; r < kRows; ++r) {
      const std::size_t from = index(i + kOffsets[r][0], j + kOffsets[r][1], k - margin_);
      rows[r][0] = start_[from];
      rows[r][1] = start_[from + 2 * static_cast<std::size_t>(margin_) + 1];
    }
    return {x_.empty() ? nullptr : x_.front().data(), rows, kRows};
  }

 private:
  /// Cells run from -1 to width (z: only in 3D).
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(
        ((i + 1) * (lattice_.width + 2) + j + 1) * (lattice_.depth + 2 * margin_) + k + margin_);
  }

  const Lattice& lattice_;
  int margin_;  // cells beyond the block along z
  std::vector<Local> x_;
  std::vector<std::uint32_t> start_;  // per cell; one more at the end
};

}  // namespace lather::mpm::resample
