#pragma once

#include <optional>

#include "sim/collide/obstacles.h"
#include "sim/particles/particle_set.h"

namespace lather::mpm {

/// Number of empty cells of the grid that no path of empty cells (through faces) joins to the domain's edge:
/// voids inside the material. Cells whose centre lies in an obstacle, or less than a cell's width outside,
/// are neither empty nor counted: material stands off an obstacle by about half a cell. Only the box of the
/// occupied cells is searched, with a margin of a cell; on periodic axes it is the whole period and has no
/// edge. Nothing where that box has more than kMostSearchedCells.
template <class Real>
[[nodiscard]] std::optional<std::uint64_t> count_interior_voids(const std::vector<ParticleSet<Real>>& sets,
                                                                const CellBounds& bounds,
                                                                const Obstacles& obstacles,
                                                                const Vec3& origin, double cell);

}  // namespace lather::mpm
