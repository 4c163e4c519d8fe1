#include "sim/mpm/interior_voids.h"

#include <algorithm>
#include <limits>

#include "sim/plan/void_search.h"

namespace lather::mpm {
namespace {

/// The searched box of cells, one byte each, z fastest.
class CellBox {
 public:
  enum State : char { kEmpty, kTaken, kReached };

  CellBox(const CellBounds& bounds, const std::array<int, 3>& low, const std::array<int, 3>& high)
      : bounds_(bounds), low_(low) {
    for (int a = 0; a < bounds.dimension; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      low_[axis] = bounds.periodic[axis] ? 0 : low[axis] - 1;
      count_[axis] = bounds.periodic[axis] ? bounds.cells[axis] : high[axis] + 1 - low_[axis] + 1;
    }
  }
  [[nodiscard]] double size() const {
    return static_cast<double>(count_[0]) * count_[1] * static_cast<double>(count_[2]);
  }
  void allocate() { cells_.assign(static_cast<std::size_t>(size()), kEmpty); }

  /// Index of a cell given by the domain's coordinates.
  [[nodiscard]] std::size_t index(const std::array<int, 3>& cell) const {
    std::size_t at = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const int n = count_[a];
      const int i = cell[a] - low_[a];
      at = at * static_cast<std::size_t>(n) + static_cast<std::size_t>(((i % n) + n) % n);
    }
    return at;
  }
  [[nodiscard]] std::array<int, 3> place(std::size_t index) const {  ///< in the box
    const auto y = static_cast<std::size_t>(count_[1]);
    const auto z = static_cast<std::size_t>(count_[2]);
    return {static_cast<int>(index / z / y), static_cast<int>(index / z % y), static_cast<int>(index % z)};
  }
  [[nodiscard]] std::size_t cells() const { return cells_.size(); }
  [[nodiscard]] char& at(std::size_t index) { return cells_[index]; }

  /// Centre of a cell of the box, in cells from the domain's corner.
  [[nodiscard]] Vec3 center(std::size_t index) const {
    const std::array<int, 3> p = place(index);
    Vec3 x = Vec3::Zero();
    for (int a = 0; a < bounds_.dimension; ++a)
      x[a] = low_[static_cast<std::size_t>(a)] + p[static_cast<std::size_t>(a)] + 0.5;
    return x;
  }

  /// Marks all empty cells that the box's faces reach.
  void flood() {
    std::vector<std::size_t> front;
    const auto reach = [&](std::size_t index) {
      if (cells_[index] != kEmpty) return;
      cells_[index] = kReached;
      front.push_back(index);
    };
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (on_face(place(i))) reach(i);
    while (!front.empty()) {
      const std::array<int, 3> p = place(front.back());
      front.pop_back();
      for (int a = 0; a < bounds_.dimension; ++a)
        for (const int step : {-1, 1}) {
          std::array<int, 3> next = p;
          const auto axis = static_cast<std::size_t>(a);
          next[axis] += step;
          if (!bounds_.periodic[axis] && (next[axis] < 0 || next[axis] >= count_[axis])) continue;
          for (std::size_t b = 0; b < 3; ++b) next[b] += low_[b];
          reach(index(next));
        }
    }
  }

 private:
  [[nodiscard]] bool on_face(const std::array<int, 3>& p) const {
    for (int a = 0; a < bounds_.dimension; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      if (!bounds_.periodic[axis] && (p[axis] == 0 || p[axis] == count_[axis] - 1)) return true;
    }
    return false;
  }

  const CellBounds& bounds_;
  std::array<int, 3> low_{};
  std::array<int, 3> count_ = {1, 1, 1};
  std::vector<char> cells_;
};

/// Calls visit(cell) for the cell of every point.
template <class Real, class Visit>
void for_cells(const std::vector<ParticleSet<Real>>& sets, int dimension, const Visit& visit) {
  for (const ParticleSet<Real>& set : sets)
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        if (set.template values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
        std::array<int, 3> cell{};
        for (int a = 0; a < dimension; ++a)
          cell[static_cast<std::size_t>(a)] = set.template values<std::int16_t>(t, Field::kCell, a)[lane];
        visit(cell);
      }
}

}  // namespace

template <class Real>
std::optional<std::uint64_t> count_interior_voids(const std::vector<ParticleSet<Real>>& sets,
                                                  const CellBounds& bounds, const Obstacles& obstacles,
                                                  const Vec3& origin, double cell) {
  std::array<int, 3> low;
  std::array<int, 3> high;
  low.fill(std::numeric_limits<int>::max());
  high.fill(std::numeric_limits<int>::min());
  for_cells(sets, bounds.dimension, [&](const std::array<int, 3>& c) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], c[a]);
      high[a] = std::max(high[a], c[a]);
    }
  });
  if (low[0] > high[0]) return 0;
  CellBox box(bounds, low, high);
  if (box.size() > kMostSearchedCells) return std::nullopt;
  box.allocate();
  for_cells(sets, bounds.dimension,
            [&](const std::array<int, 3>& c) { box.at(box.index(c)) = CellBox::kTaken; });
  if (!obstacles.none()) {
    std::vector<std::uint32_t> around;
    for (std::size_t i = 0; i < box.cells(); ++i) {
      if (box.at(i) == CellBox::kTaken) continue;
      obstacles.find_near(origin + cell * box.center(i), cell, around);
      if (!around.empty()) box.at(i) = CellBox::kTaken;
    }
  }
  box.flood();
  std::uint64_t voids = 0;
  for (std::size_t i = 0; i < box.cells(); ++i) voids += box.at(i) == CellBox::kEmpty ? 1 : 0;
  return voids;
}

template std::optional<std::uint64_t> count_interior_voids(const std::vector<ParticleSet<float>>&,
                                                           const CellBounds&, const Obstacles&, const Vec3&,
                                                           double);
template std::optional<std::uint64_t> count_interior_voids(const std::vector<ParticleSet<double>>&,
                                                           const CellBounds&, const Obstacles&, const Vec3&,
                                                           double);

}  // namespace lather::mpm
