#include "sim/collide/obstacles.h"

#include <cmath>
#include <limits>

#include "sim/shape/unbounded.h"

namespace lather {

Obstacles::Obstacles(const Scene& scene, double spacing)
    : scene_obstacles_(scene.obstacles), normal_step_(0.01 * spacing), flat_(scene.dimension == 2) {
  // Obstacles may move, so what the domain cuts off of a half space at first may come in later.
  const Box3 everywhere{Vec3::Constant(-1e9), Vec3::Constant(1e9)};
  for (const Obstacle& o : scene_obstacles_) {
    const Box3 box = bounds(*o.shape, everywhere);
    Placed placed;
    placed.source = &o;
    placed.middle = box.center();
    placed.reach =
        is_unbounded(*o.shape) ? std::numeric_limits<double>::infinity() : 0.5 * box.extent().norm();
    all_.push_back(placed);
  }
}

void Obstacles::place(double time, double dt) {
  for (Placed& o : all_) {
    const Motion& motion = o.source->motion;
    o.pose = pose_at(motion, time);
    o.place = o.pose.rotation * o.middle + o.pose.translation;
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
  for (std::uint32_t i = 0; i < all_.size(); ++i) {
    const Placed& o = all_[i];
    const double far = o.reach + radius;
    if ((center - o.place).squaredNorm() > far * far) continue;
    if (distance(*o.source->shape, to_local(o, center)) < radius) near.push_back(i);
  }
}

double Obstacles::distance_from(std::uint32_t obstacle, const Vec3& x) const {
  const Placed& o = all_[obstacle];
  return distance(*o.source->shape, to_local(o, x));
}

std::optional<Obstacles::Touch> Obstacles::touch(std::uint32_t obstacle, const Vec3& x, double radius) const {
  const Placed& o = all_[obstacle];
  const Vec3 local = to_local(o, x);
  if (distance(*o.source->shape, local) >= radius) return std::nullopt;
  Touch t{o.source, o.velocity_at_origin + o.velocity_gradient * x, Vec3::Zero()};
  if (o.source->adhesive) return t;
  t.normal = o.pose.rotation * normal(*o.source->shape, local, normal_step_);
  if (flat_) {
    t.normal.z() = 0;
    const double length = t.normal.norm();
    if (length == 0) return std::nullopt;
    t.normal /= length;
  }
  return t;
}

/// What is left of a slip velocity that loses `stop` (m/s).
static Vec3 after_friction(const Vec3& slip, double stop) {
  const double speed = slip.norm();
  return speed <= stop ? Vec3(Vec3::Zero()) : Vec3(slip * (1 - stop / speed));
}

std::optional<Vec3> Obstacles::after_contact(const Touch& t, const Vec3& velocity) {
  if (t.source->adhesive) return t.velocity;
  const Vec3 v_rel = velocity - t.velocity;
  const double v_n = v_rel.dot(t.normal);
  if (v_n >= 0) return std::nullopt;
  return t.velocity + after_friction(v_rel - t.normal * v_n, -t.source->friction * v_n);
}

bool Obstacles::resolve(const std::vector<std::uint32_t>& near, const Vec3& x, Vec3& velocity, double mass,
                        const ContactSink& sink, double radius) const {
  bool changed = false;
  for (const std::uint32_t i : near) {
    const std::optional<Touch> t = touch(i, x, radius);
    const std::optional<Vec3> after = t ? after_contact(*t, velocity) : std::nullopt;
    if (!after) continue;
    sink.take(i, x, velocity - *after, mass);
    velocity = *after;
    changed = true;
  }
  return changed;
}

void Obstacles::hold(const std::vector<std::uint32_t>& near, const Vec3& x, const Vec3& velocity,
                     Hold& hold) const {
  for (const std::uint32_t i : near) {
    const std::optional<Touch> t = touch(i, x, 0);
    if (!t) continue;
    if (t->source->adhesive) {
      hold.all(t->velocity);
      continue;
    }
    const Vec3 v_rel = hold.meet(velocity) - t->velocity;
    const double v_n = v_rel.dot(t->normal);
    if (v_n >= 0) continue;
    const double slip = (v_rel - t->normal * v_n).norm();
    hold.along(t->normal, t->velocity, t->source->friction, slip <= -t->source->friction * v_n);
  }
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

bool Walls::resolve(const Vec3& x, Vec3& velocity, double mass, const ContactSink& sink, double radius,
                    double ahead) const {
  const Vec3 before = velocity;
  if (!touch(x, velocity, radius, ahead)) return false;
  sink.take(index_, x, before - velocity, mass);
  return true;
}

bool Walls::touch(const Vec3& x, Vec3& velocity, double radius, double ahead) const {
  bool changed = false;
  for (int a = 0; a < dimension_; ++a) {
    if (!closed_[static_cast<std::size_t>(a)]) continue;
    // Room below and above, in front of the faces.
    const double below = x[a] - (box_.min[a] + radius);
    const double above = box_.max[a] - radius - x[a];
    const double way = velocity[a] * ahead;
    const bool down = below <= tolerance_ || way < -below;
    const bool up = above <= tolerance_ || way > above;
    if (!down && !up) continue;
    // As far as the face, where there is still a way to it.
    double allowed = 0;
    if (way < -below && below > tolerance_) allowed = -below / ahead;
    if (way > above && above > tolerance_) allowed = above / ahead;
    if (stick_) {
      velocity.setZero();
      velocity[a] = allowed;
      return true;
    }
    if ((down && velocity[a] < 0) || (up && velocity[a] > 0)) {
      velocity[a] = allowed;
      changed = true;
    }
  }
  return changed;
}

void Walls::hold(const Vec3& x, const Vec3& velocity, Hold& hold) const {
  for (int a = 0; a < dimension_; ++a) {
    if (!closed_[static_cast<std::size_t>(a)]) continue;
    const bool below = x[a] <= box_.min[a] + tolerance_;
    const bool above = x[a] >= box_.max[a] - tolerance_;
    if (!below && !above) continue;
    if (stick_) return hold.all(Vec3::Zero());
    const double speed = hold.meet(velocity)[a];
    if ((below && speed < 0) || (above && speed > 0)) hold.along(Vec3::Unit(a), Vec3::Zero(), 0, false);
  }
}

}  // namespace lather
