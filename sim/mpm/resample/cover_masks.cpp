#include "sim/mpm/resample/cover_masks.h"

#include <algorithm>
#include <cmath>

namespace lather::mpm::resample {
namespace {

/// Bit of part (i, j, k) of a lattice cell with `parts` of them per axis.
unsigned part_bit(int i, int j, int k, int parts, int dimension) {
  return static_cast<unsigned>(dimension == 3 ? (i * parts + j) * parts + k : i * parts + j);
}

/// The largest distance along an axis between the place `p` (of `places`) of cell 0 and part `s` (of `parts`)
/// of cell `c`.
double farthest(int p, int places, int s, int parts, int c) {
  const double low = static_cast<double>(p) / places;
  const double high = static_cast<double>(p + 1) / places;
  const double from = c + static_cast<double>(s) / parts;
  const double to = c + static_cast<double>(s + 1) / parts;
  return std::max(high - from, to - low);
}

}  // namespace

float cover_radius(int dimension) {
  return static_cast<float>(std::sqrt(static_cast<double>(dimension)) / 2 + 0.01);
}

const CoverMasks& CoverMasks::of(int dimension) {
  static const CoverMasks plane(2);
  static const CoverMasks space(3);
  return dimension == 2 ? plane : space;
}

CoverMasks::CoverMasks(int dimension)
    : dimension_(dimension),
      places_(dimension == 3 ? 9 : 27),
      parts_(dimension == 3 ? 4 : 8),
      cover_radius_(cover_radius(dimension)) {
  const int zp = dimension == 3 ? places_ : 1;
  const int zc = dimension == 3 ? 1 : 0;
  for (int p = 0; p < places_ * places_ * zp; ++p) {
    const std::array<int, 3> place = {p / zp / places_, p / zp % places_, p % zp};
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -zc; k <= zc; ++k) table_.push_back(mask(place, {i, j, k}));
  }
  for (int n = 1; n <= parts_; n *= 2)  // cells per axis of this level
    for (int c = 0; c < power(n, dimension); ++c) {
      const int size = parts_ / n;  // in parts
      const int at[3] = {dimension == 3 ? c / n / n : c / n, dimension == 3 ? c / n % n : c % n,
                         dimension == 3 ? c % n : 0};
      TreeCell cell = {0, {0, 0, 0}, 1.0F / static_cast<float>(n)};
      for (int a = 0; a < dimension; ++a)
        cell.low[static_cast<std::size_t>(a)] = cell.width * static_cast<float>(at[a]);
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j)
          for (int k = 0; k < (dimension == 3 ? size : 1); ++k)
            cell.mask |= std::uint64_t{1}
                         << part_bit(at[0] * size + i, at[1] * size + j, at[2] * size + k, parts_, dimension);
      tree_.push_back(cell);
    }
}

/// The parts of `cell` that a sphere around any point of `place` covers whole.
std::uint64_t CoverMasks::mask(const std::array<int, 3>& place, const std::array<int, 3>& cell) const {
  const double radius = cover_radius(dimension_) - 1e-5;  // less the rounding of positions in float
  std::uint64_t bits = 0;
  for (int i = 0; i < parts_; ++i)
    for (int j = 0; j < parts_; ++j)
      for (int k = 0; k < (dimension_ == 3 ? parts_ : 1); ++k) {
        const int part[3] = {i, j, k};
        double squared = 0;
        for (int a = 0; a < dimension_; ++a) {
          const auto axis = static_cast<std::size_t>(a);
          const double d = farthest(place[axis], places_, part[a], parts_, cell[axis]);
          squared += d * d;
        }
        if (squared <= radius * radius) bits |= std::uint64_t{1} << part_bit(i, j, k, parts_, dimension_);
      }
  return bits;
}

void CoverMasks::clear(const Lattice& lattice, std::vector<std::uint64_t>& covered) const {
  const int n = lattice.width + 2 * kMargin;
  covered.assign(static_cast<std::size_t>(n * n * (dimension_ == 3 ? n : 1)), 0);
}

void CoverMasks::cover(const Lattice& lattice, const Local& x, std::vector<std::uint64_t>& covered) const {
  int cell[3] = {0, 0, 0};
  int place = 0;
  float corner = 0;  // squared distance of the farthest one of the own cell
  for (int a = 0; a < dimension_; ++a) {
    const float at = x[static_cast<std::size_t>(a)];
    cell[a] = static_cast<int>(at + kMargin) - kMargin;  // the floor: x is at least -kMargin
    const float f = at - static_cast<float>(cell[a]);
    place = place * places_ + std::min(static_cast<int>(f * static_cast<float>(places_)), places_ - 1);
    const float far = std::max(f, 1 - f);
    corner += far * far;
  }
  const int zc = dimension_ == 3 ? 1 : 0;
  const std::uint64_t* masks = table_.data() + static_cast<std::ptrdiff_t>(place) * power(3, dimension_);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      std::uint64_t* row = covered.data() + index(lattice, cell[0] + i, cell[1] + j, cell[2] - zc);
      for (int k = 0; k <= 2 * zc; ++k) row[k] |= *masks++;
    }
  const float radius = cover_radius_ - 1e-5F;
  if (corner <= radius * radius) covered[index(lattice, cell[0], cell[1], cell[2])] = ~std::uint64_t{0};
}

}  // namespace lather::mpm::resample
