#include "sim/collide/obstacles.h"

#include <cmath>

namespace lather {

Obstacles::Obstacles(const Scene& scene, double spacing)
    : scene_obstacles_(scene.obstacles), normal_step_(0.01 * spacing), flat_(scene.dimension == 2) {
  for (const Obstacle& o : scene_obstacles_) all_.push_back({&o, {}, Vec3::Zero(), Mat3::Zero()});
}

void Obstacles::place(double time, double dt) {
  for (Placed& o : all_) {
    const Motion& motion = o.source->motion;
    o.pose = pose_at(motion, time);
    if (std::holds_alternative<AtRest>(motion)) continue;
    // A rigid velocity is affine in x: four samples hold all of it.
    const double middle = time + 0.5 * dt;
    o.velocity_at_origin = velocity_at(motion, middle, Vec3::Zero());
    for (int a = 0; a < 3; ++a)
      o.velocity_gradient.col(a) = velocity_at(motion, middle, Vec3::Unit(a)) - o.velocity_at_origin;
  }
}

void Obstacles::find_near(const Vec3& center, double radius, std::vector<std::uint32_t>& near) const {
  near.clear();
  for (std::uint32_t i = 0; i < all_.size(); ++i)
    if (distance(*all_[i].source->shape, to_local(all_[i], center)) < radius) near.push_back(i);
}

bool Obstacles::resolve(const std::vector<std::uint32_t>& near, const Vec3& x, Vec3& velocity, double mass,
                        const ContactSink& sink) const {
  bool changed = false;
  for (const std::uint32_t i : near) {
    const Vec3 before = velocity;
    if (!touch(all_[i], x, velocity)) continue;
    changed = true;
    sink.take(i, x, before - velocity, mass);
  }
  return changed;
}

bool Obstacles::touch(const Placed& o, const Vec3& x, Vec3& velocity) const {
  const Vec3 local = to_local(o, x);
  if (distance(*o.source->shape, local) >= 0) return false;
  const Vec3 v_obstacle = o.velocity_at_origin + o.velocity_gradient * x;
  if (o.source->adhesive) {
    velocity = v_obstacle;
    return true;
  }
  Vec3 n = o.pose.rotation * normal(*o.source->shape, local, normal_step_);
  if (flat_) {
    n.z() = 0;
    const double length = n.norm();
    if (length == 0) return false;
    n /= length;
  }
  const Vec3 v_rel = velocity - v_obstacle;
  const double v_n = v_rel.dot(n);
  if (v_n >= 0) return false;
  const Vec3 v_t = v_rel - n * v_n;
  const double slip = v_t.norm();
  const double stop = -o.source->friction * v_n;
  velocity = slip <= stop ? v_obstacle : Vec3(v_obstacle + v_t * (1 - stop / slip));
  return true;
}

Walls::Walls(const Scene& scene)
    : box_(scene.domain.box),
      dimension_(scene.dimension),
      index_(scene.obstacles.size()),
      stick_(scene.domain.boundary == Boundary::kStick),
      tolerance_(1e-6 * scene.spacing) {
  for (int a = 0; a < dimension_; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    periodic_[axis] = scene.domain.periodic[axis];
    closed_[axis] = !scene.domain.periodic[axis] && scene.domain.boundary != Boundary::kOpen;
  }
}

bool Walls::near(const Vec3& low, const Vec3& high, double margin) const {
  for (int a = 0; a < dimension_; ++a)
    if (closed_[static_cast<std::size_t>(a)] &&
        (low[a] - margin < box_.min[a] || high[a] + margin > box_.max[a]))
      return true;
  return false;
}

bool Walls::inside(const Vec3& x) const {
  for (int a = 0; a < dimension_; ++a)
    if (!periodic_[static_cast<std::size_t>(a)] && (x[a] < box_.min[a] || x[a] > box_.max[a])) return false;
  return true;
}

bool Walls::resolve(const Vec3& x, Vec3& velocity, double mass, const ContactSink& sink) const {
  const Vec3 before = velocity;
  if (!touch(x, velocity)) return false;
  sink.take(index_, x, before - velocity, mass);
  return true;
}

bool Walls::touch(const Vec3& x, Vec3& velocity) const {
  bool changed = false;
  for (int a = 0; a < dimension_; ++a) {
    if (!closed_[static_cast<std::size_t>(a)]) continue;
    const bool below = x[a] <= box_.min[a] + tolerance_;
    const bool above = x[a] >= box_.max[a] - tolerance_;
    if (!below && !above) continue;
    if (stick_) {
      velocity.setZero();
      return true;
    }
    if ((below && velocity[a] < 0) || (above && velocity[a] > 0)) {
      velocity[a] = 0;
      changed = true;
    }
  }
  return changed;
}

}  // namespace lather
