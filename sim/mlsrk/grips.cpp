#include "sim/mlsrk/grips.h"

#include <algorithm>
#include <cmath>

namespace lather::mlsrk {

Grips::Grips(const Scene& scene) : all_(scene.grips), steps_(scene.grips.size()) {
  for (const Grip& grip : all_) reaches_.push_back(reach_of(scene, grip));
}

Grips::Reach Grips::reach_of(const Scene& scene, const Grip& grip) {
  Box3 box = scene.domain.box;
  const auto cut = [&box](const Box3& by) {
    box.min = box.min.cwiseMax(by.min);
    box.max = box.max.cwiseMin(by.max).cwiseMax(box.min);
  };
  for (const Body& body : scene.bodies)
    if (body.name == grip.body) cut(bounds(*body.shape, scene.domain.box));
  if (grip.shape != nullptr) cut(bounds(*grip.shape, scene.domain.box));
  return {box.center(), 0.5 * box.extent().norm()};
}

Grips::Step Grips::step_of(const Grip& grip, double time, double dt) {
  Step out;
  out.active = time >= grip.start && time < grip.end;
  if (!out.active || std::holds_alternative<AtRest>(grip.motion)) return out;
  const Pose from = pose_at(grip.motion, time);
  const Pose to = pose_at(grip.motion, time + dt);
  const Mat3 turn = (to.rotation * from.rotation.conjugate()).toRotationMatrix();
  out.gradient = (turn - Mat3::Identity()) / dt;
  out.at_origin = (to.translation - turn * from.translation) / dt;
  return out;
}

void Grips::place(double time, double dt) {
  for (std::size_t g = 0; g < all_.size(); ++g) steps_[g] = step_of(all_[g], time, dt);
}

double Grips::fastest(double time, double dt) const {
  double most = 0;
  for (std::size_t g = 0; g < all_.size(); ++g) {
    const Step step = step_of(all_[g], time, dt);
    if (!step.active) continue;
    const Pose start = pose_at(all_[g].motion, all_[g].start);
    const Pose now = pose_at(all_[g].motion, time);
    const Vec3 middle =
        now.rotation * (start.rotation.conjugate() * (reaches_[g].middle - start.translation)) +
        now.translation;
    // A rotation changes every vector across its axis by the same share of its length.
    const double turning = step.gradient.norm() / std::sqrt(2.0);
    most = std::max(most, step.velocity(middle).norm() + turning * reaches_[g].radius);
  }
  return most;
}

}  // namespace lather::mlsrk
