#include "sim/particles/block.h"

#include <cmath>

namespace lather {

CellBounds cell_bounds(const Scene& scene) {
  CellBounds b;
  b.dimension = scene.dimension;
  b.periodic = scene.domain.periodic;
  b.open = scene.domain.boundary == Boundary::kOpen;
  const Vec3 extent = scene.domain.box.extent();
  for (int a = 0; a < scene.dimension; ++a)
    b.cells[static_cast<std::size_t>(a)] =
        static_cast<std::int32_t>(std::ceil(extent[a] / scene.spacing - 1e-6));
  for (int a = scene.dimension; a < 3; ++a) b.periodic[static_cast<std::size_t>(a)] = false;
  return b;
}

}  // namespace lather
