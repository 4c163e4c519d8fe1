// What walls, obstacles and grips do to points in a step.

#include <algorithm>
#include <limits>

#include "sim/math/parallel.h"
#include "sim/mlsrk/layers_behind.h"
#include "sim/mlsrk/step.h"

namespace lather::mlsrk {

/// Obstacles and walls hold no points, yet they take up space: to a point beside them their part of its
/// kernel counts as full. Without that, points at a wall would see empty space there and crowd until they
/// are twice as dense.
template <class Real>
void Stepper<Real>::fill_solids() {
  const double scale = cloud_.scale();
  const double reach = 2 * scale;
  const LayersBehind layers(model_.scene.spacing / scale, model_.scene.numerics.mlsrk.kernel_shape,
                            model_.scene.dimension);
  parallel_for(threads_, static_cast<std::int64_t>(cloud_.tiles().size()), 16, [&](std::int64_t index) {
    clock_.time(Stage::kShapeFunctions, [&] {
      const auto t = static_cast<std::size_t>(index);
      const Box3 box = cloud_.box(t);
      std::vector<std::uint32_t>& near = scratch().near;
      obstacles_.find_near(box.center(), 0.5 * box.extent().norm() + reach, near);
      const bool walls = model_.walls.near(box.min, box.max, reach);
      if (near.empty() && !walls) return;
      for (int i = 0; i < cloud_.tiles()[t].count; ++i) {
        const Vec3 x = cloud_.position(static_cast<std::uint32_t>(t * kTile) + static_cast<std::uint32_t>(i));
        double open = 1;  // share of the kernel that is open to points
        const auto close = [&](double distance) {
          open *= 1 - layers.share((distance - model_.stand_off) / scale);
        };
        for (const std::uint32_t o : near) close(obstacles_.distance_from(o, x));
        if (walls) model_.walls.for_faces(x, close);
        crowding_[t * kTile + static_cast<std::size_t>(i)] +=
            model_.lattice_crowding * static_cast<Real>(1 - open);
      }
    });
  });
}

template <class Real>
void Stepper<Real>::resolve_collisions(std::size_t tile, double dt, Scratch& scratch) {
  const Box3 box = cloud_.box(tile);
  const double stand_off = model_.stand_off;
  obstacles_.find_near(box.center(), 0.5 * box.extent().norm() + stand_off, scratch.near);
  const bool walls = model_.walls.near(box.min, box.max, stand_off + model_.scene.spacing);
  if (scratch.near.empty() && !walls) return;
  static const WatchedContacts nobody;
  const ContactSink sink(nobody, nullptr);
  const auto first = static_cast<std::uint32_t>(tile * kTile);
  for (std::uint32_t slot = first; slot < first + static_cast<std::uint32_t>(cloud_.tiles()[tile].count);
       ++slot) {
    Vec3 v = Vec3::Zero();
    for (int a = 0; a < model_.scene.dimension; ++a) v[a] = static_cast<double>(velocity(slot, a));
    const Vec3 x = cloud_.position(slot);
    const auto mass = static_cast<double>(velocity(slot, 3));
    bool changed = obstacles_.resolve(scratch.near, x, v, mass, sink, stand_off);
    if (walls) changed = model_.walls.resolve(x, v, mass, sink, stand_off, dt) || changed;
    if (!changed) continue;
    for (int a = 0; a < model_.scene.dimension; ++a) velocity(slot, a) = static_cast<Real>(v[a]);
  }
}

/// Gives the points of grips their prescribed velocities. False where one passes a face of the domain.
template <class Real>
bool Stepper<Real>::drive_points(std::size_t tile, double dt) {
  const Box3& box = model_.scene.domain.box;
  const double rounding =
      static_cast<double>(std::numeric_limits<Real>::epsilon()) *
      std::max({box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff(), model_.scene.spacing});
  bool inside = true;
  const std::size_t first = tile * kTile;
  for (std::size_t slot = first; slot < first + static_cast<std::size_t>(cloud_.tiles()[tile].count);
       ++slot) {
    if (!driven(slot)) continue;
    const Vec3 x = cloud_.position(static_cast<std::uint32_t>(slot));
    const Vec3 v = grips_.velocity(grip_[slot], x);
    for (int a = 0; a < model_.scene.dimension; ++a) velocity(slot, a) = static_cast<Real>(v[a]);
    model_.walls.for_faces(x + dt * v, [&](double before) { inside = inside && before >= -rounding; });
  }
  return inside;
}

template void Stepper<float>::fill_solids();
template void Stepper<double>::fill_solids();
template void Stepper<float>::resolve_collisions(std::size_t, double, Scratch&);
template void Stepper<double>::resolve_collisions(std::size_t, double, Scratch&);
template bool Stepper<float>::drive_points(std::size_t, double);
template bool Stepper<double>::drive_points(std::size_t, double);

}  // namespace lather::mlsrk
