#include "sim/report/pieces.h"

#include <algorithm>
#include <array>
#include <functional>

#include "sim/math/disjoint_sets.h"

namespace lather {
namespace {

/// An occupied cell: its key orders as its coordinates do.
struct Cell {
  std::array<std::int32_t, 3> at{};
  std::uint64_t points = 0;
};

bool before(const Cell& a, const Cell& b) {
  return a.at < b.at;
}

std::int32_t wrapped(std::int32_t cell, std::size_t axis, const CellBounds& bounds) {
  if (!bounds.periodic[axis]) return cell;
  const std::int32_t n = bounds.cells[axis];
  return ((cell % n) + n) % n;
}

/// Occupied cells of `width` spacings in ascending order, each once, with their points.
template <class Real>
std::vector<Cell> occupied_cells(const std::vector<ParticleSet<Real>>& sets, const CellBounds& bounds,
                                 int width) {
  std::vector<Cell> cells;
  for (const ParticleSet<Real>& set : sets)
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        if (set.template values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
        Cell c{{}, 1};
        for (int a = 0; a < bounds.dimension; ++a) {
          const auto axis = static_cast<std::size_t>(a);
          const std::int32_t cell = set.template values<std::int16_t>(t, Field::kCell, a)[lane];
          c.at[axis] = wrapped(cell / width - (cell % width < 0 ? 1 : 0), axis, bounds);
        }
        // Points come sorted by block: most repeat a cell met lately.
        if (!cells.empty() && cells.back().at == c.at)
          ++cells.back().points;
        else
          cells.push_back(c);
      }
  std::sort(cells.begin(), cells.end(), before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0 && cells[i].at == cells[kept - 1].at)
      cells[kept - 1].points += cells[i].points;
    else
      cells[kept++] = cells[i];
  }
  cells.resize(kept);
  return cells;
}

}  // namespace

template <class Real>
Pieces find_pieces(const std::vector<ParticleSet<Real>>& sets, const CellBounds& fine, int width) {
  CellBounds bounds = fine;
  for (std::int32_t& n : bounds.cells) n = (n + width - 1) / width;
  const std::vector<Cell> cells = occupied_cells(sets, bounds, width);
  DisjointSets connected(cells.size());
  const int across = bounds.dimension == 3 ? 1 : 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (int dx = 0; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -across; dz <= across; ++dz) {
          if (dx == 0 && (dy < 0 || (dy == 0 && dz <= 0))) continue;  // each pair of neighbours once
          Cell near = cells[i];
          const std::array<int, 3> step = {dx, dy, dz};
          for (std::size_t a = 0; a < 3; ++a) near.at[a] = wrapped(near.at[a] + step[a], a, bounds);
          const auto found = std::lower_bound(cells.begin(), cells.end(), near, before);
          if (found != cells.end() && found->at == near.at)
            connected.join(i, static_cast<std::size_t>(found - cells.begin()));
        }

  std::vector<std::uint64_t> points(cells.size(), 0);
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    points[connected.root(i)] += cells[i].points;
    all += cells[i].points;
  }
  std::sort(points.begin(), points.end(), std::greater<>());
  Pieces pieces;
  if (all == 0) return pieces;
  const auto share = [&](std::size_t i) {
    return i < points.size() ? static_cast<double>(points[i]) / static_cast<double>(all) : 0.0;
  };
  while (pieces.count < points.size() && share(pieces.count) >= kLeastPiece) ++pieces.count;
  pieces.largest_share = share(0);
  pieces.second_share = share(1);
  return pieces;
}

template Pieces find_pieces(const std::vector<ParticleSet<float>>&, const CellBounds&, int);
template Pieces find_pieces(const std::vector<ParticleSet<double>>&, const CellBounds&, int);

std::optional<double> tear_time(const std::vector<FrameMeasure>& frames, double share, double lasting) {
  const FrameMeasure* torn = nullptr;
  for (const FrameMeasure& frame : frames) {
    if (frame.second_piece_share < share) {
      torn = nullptr;
      continue;
    }
    if (torn == nullptr) torn = &frame;
    if (frame.time >= torn->time + lasting) return torn->time;
  }
  return std::nullopt;
}

}  // namespace lather
