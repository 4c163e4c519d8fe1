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

  /// True if pred(x) holds for some point of the 3^dim cells around cell (i, j, k); the nearest cells first.
  template <class Pred>
  [[nodiscard]] bool any_around(int i, int j, int k, const Pred& pred) const {
    static constexpr int kRows[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                        {-1, -1}, {-1, 1}, {1, -1}, {1, 1}};
    for (const auto& row : kRows) {
      const std::size_t from = index(i + row[0], j + row[1], k - margin_);
      const std::size_t end = start_[from + 2 * static_cast<std::size_t>(margin_) + 1];
      for (std::size_t p = start_[from]; p < end; ++p)
        if (pred(x_[p])) return true;
    }
    return false;
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
