#include "sim/study/scene_parts.h"

#include <cmath>

#include "sim/plan/seed.h"

namespace lather::study {

ShapePtr box_at(const Vec3& center, const Vec3& size) {
  const auto box = std::make_shared<const Shape>(Shape{BoxShape{size, 0}});
  return std::make_shared<const Shape>(Shape{PlacedShape(box, center)});
}

Material material_of(const Law& law) {
  Material m;
  m.name = "material";
  m.law = law;
  return m;
}

Scene particle_scene(const std::string& name, double spacing, const Law& law) {
  Scene scene;
  scene.name = name;
  scene.solver = Solver::kMlsrk;
  scene.dimension = 2;
  scene.gravity = Vec3::Zero();
  scene.spacing = spacing;
  scene.points_per_cell = 1;
  scene.materials.push_back(material_of(law));
  scene.numerics.precision = Precision::kDouble;
  return scene;
}

Body body_of(const Scene& scene, const ShapePtr& shape, const Vec3& velocity) {
  Body body;
  body.name = "body " + std::to_string(scene.bodies.size());
  body.material = scene.materials.front().name;
  body.shape = shape;
  body.velocity = velocity;
  return body;
}

void set_frames(Scene& scene, double time, int frames) {
  scene.duration = time;
  scene.frame_rate = frames / time;
}

void add_layers(Scene& scene, const Box3& region, int axis, const std::function<Vec3(double)>& velocity) {
  const double thickness = point_distance(scene);
  const auto layers = static_cast<int>(std::lround(region.extent()[axis] / thickness));
  for (int i = 0; i < layers; ++i) {
    Vec3 center = region.center();
    center[axis] = region.min[axis] + (i + 0.5) * thickness;
    Vec3 size = Vec3::Constant(4 * region.extent().maxCoeff());
    size[axis] = thickness;
    scene.bodies.push_back(body_of(scene, box_at(center, size), velocity(center[axis])));
  }
}

void run_to(Simulation& simulation, int index) {
  simulation.step_to_frame(index, [](const Progress&) { return true; });
}

}  // namespace lather::study
