#pragma once

#include <cstdint>
#include <vector>

#include "sim/mpm/resample/point_bins.h"

namespace lather::mpm::resample {

/// Radius of the spheres that new points must stay out of, in units of r: a little more than half the
/// diagonal of a cell, so that an undisturbed lattice leaves no gap. [Foam section 6.1]
[[nodiscard]] float cover_radius(int dimension);

/// A cell of the tree below a lattice cell [Foam Algorithm 3]: widths r, r/2, … down to r/4 in 3D, r/8 in 2D.
struct TreeCell {
  std::uint64_t mask;  ///< its parts of the finest width: one bit each of the lattice cell's 64
  Local low;           ///< its corner within the lattice cell
  float width;
};

/// Which parts of a lattice cell are covered for sure by one sphere, as bits. A table by the point's place in
/// its own cell, to a ninth of the cell's width (a third of that in 2D), answers with 27 look-ups a point
/// what would take some hundred distances. What it leaves open is left to the darts, which are tested
/// exactly.
class CoverMasks {
 public:
  /// The table of 2 or 3 dimensions, made once.
  [[nodiscard]] static const CoverMasks& of(int dimension);

  /// All cells of the tree, coarse to fine.
  [[nodiscard]] const std::vector<TreeCell>& tree() const { return tree_; }

  /// The masks of one block's cells and of two beyond it on each side, in `covered`: empty.
  void clear(const Lattice& lattice, std::vector<std::uint64_t>& covered) const;
  /// Marks what the sphere around `x` covers in the 3^dim cells around its own; x is relative to the block's
  /// corner and may lie a cell outside. In its own cell the test is exact for the cell as a whole.
  void cover(const Lattice& lattice, const Local& x, std::vector<std::uint64_t>& covered) const;
  /// Index of a cell's mask.
  [[nodiscard]] static std::size_t index(const Lattice& lattice, int i, int j, int k) {
    const int z = lattice.dimension == 3 ? kMargin : 0;
    return static_cast<std::size_t>(
        ((i + kMargin) * (lattice.width + 2 * kMargin) + j + kMargin) * (lattice.depth + 2 * z) + k + z);
  }

 private:
  explicit CoverMasks(int dimension);
  [[nodiscard]] std::uint64_t mask(const std::array<int, 3>& place, const std::array<int, 3>& cell) const;

  static constexpr int kMargin = 2;  // cells

  int dimension_;
  int places_;  // per axis of a lattice cell
  int parts_;   // the same
  float cover_radius_;
  std::vector<std::uint64_t> table_;
  std::vector<TreeCell> tree_;
};

}  // namespace lather::mpm::resample
