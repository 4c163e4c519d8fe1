#pragma once

#include <cstdint>
#include <vector>

#include "sim/collide/obstacles.h"
#include "sim/mpm/step.h"

namespace lather::mpm {

/// Calls visit(node, x, walls) for every node with mass of a grid block that obstacles or walls are near to;
/// `near` then holds the obstacles, `walls` says whether the domain's faces count. x in m.
template <class Real, class Visit>
void for_nodes_near_contact(const Model<Real>& model, const Obstacles& obstacles, const BlockCoord& block,
                            const Real* nodes, std::vector<std::uint32_t>& near, const Visit& visit) {
  const double h = model.scene.spacing;
  const int dim = model.scene.dimension;
  const BlockPlace place = BlockGrid<Real>::place(block);
  Vec3 low = Vec3::Zero();
  Vec3 high = Vec3::Zero();
  for (int a = 0; a < dim; ++a) {
    low[a] = model.scene.domain.box.min[a] + place.first_node[a] * h;
    high[a] = low[a] + (kBlockWidth - 1) * h;
  }
  obstacles.find_near(0.5 * (low + high), 0.5 * (high - low).norm() + 1e-6 * h, near);
  const bool walls = model.walls.near(low, high, 1e-6 * h);
  if (near.empty() && !walls) return;
  for (int i = 0; i < block_nodes(dim); ++i) {
    if (nodes[i * kQuad] == Real(0)) continue;
    Vec3 x = low;
    int rest = i;
    for (int a = dim - 1; a >= 0; --a) {
      x[a] += (rest % kBlockWidth) * h;
      rest /= kBlockWidth;
    }
    visit(i, x, walls);
  }
}

/// The velocity in a node's quad, and back.
template <class Real>
[[nodiscard]] Vec3 quad_vector(const Real* quad, int dim) {
  Vec3 v = Vec3::Zero();
  for (int a = 0; a < dim; ++a) v[a] = static_cast<double>(quad[1 + a]);
  return v;
}
template <class Real>
void put_quad_vector(Real* quad, int dim, const Vec3& v) {
  for (int a = 0; a < dim; ++a) quad[1 + a] = static_cast<Real>(v[a]);
}

}  // namespace lather::mpm
