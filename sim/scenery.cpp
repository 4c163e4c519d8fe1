#include "sim/scenery.h"

#include <algorithm>
#include <optional>
#include <variant>

#include "sim/plan/seed.h"

namespace lather {
namespace {

/// Height of an obstacle that is ground: a visible plane at rest that faces straight up.
std::optional<double> ground_height(const Obstacle& obstacle) {
  const Shape* shape = obstacle.shape.get();
  while (const auto* placed = std::get_if<PlacedShape>(&shape->kind)) shape = placed->shape.get();
  if (!obstacle.visible || !std::holds_alternative<PlaneShape>(shape->kind) ||
      !std::holds_alternative<AtRest>(obstacle.motion))
    return std::nullopt;
  const Vec3 n = normal(*obstacle.shape, Vec3::Zero(), 1e-3);
  if (n.y() < 1 - 1e-9) return std::nullopt;
  return -distance(*obstacle.shape, Vec3::Zero());
}

}  // namespace

Scenery::Scenery(const Scene& scene) {
  still_.dimension = scene.dimension;
  still_.point_radius = 0.5 * point_distance(scene);
  still_.domain = scene.domain.box;
  still_.floor_height = scene.domain.box.min.y();
  for (const Material& material : scene.materials) still_.material_names.push_back(material.name);
  const double detail = std::max(scene.spacing, scene.domain.box.extent().maxCoeff() / 100);
  for (const Obstacle& o : scene.obstacles) {
    const std::optional<double> ground = scene.dimension == 3 ? ground_height(o) : std::nullopt;
    if (ground) still_.floor_height = std::max(still_.floor_height, *ground);
    if (!o.visible || ground) continue;
    const TriangleMesh mesh = tessellate(*o.shape, scene.domain.box, detail);
    props_.push_back({o.name, std::make_shared<const TriangleMesh>(mesh), o.motion});
  }
}

Frame Scenery::frame(int index, double time) const {
  Frame frame = still_;
  frame.index = index;
  frame.time = time;
  for (const Prop& prop : props_)
    frame.obstacles.push_back({prop.name, prop.mesh, pose_at(prop.motion, time)});
  return frame;
}

}  // namespace lather
