#include "sim/collide/hold.h"

#include <algorithm>

namespace lather {

void Hold::all(const Vec3& velocity) {
  held_ = true;
  free_.setZero();
  fixed_ = velocity;
  rub_.reset();
}

void Hold::along(const Vec3& normal, const Vec3& velocity, double friction, bool sticks) {
  constexpr double kSpanned = 1e-3;  // sine of the angle between a normal and the span of earlier ones
  const Vec3 left = free_ * normal;
  const double length = left.norm();
  if (length < kSpanned) return;
  held_ = true;
  const Vec3 direction = left / length;
  const Vec3 added = direction * (normal.dot(velocity - fixed_) / length);
  const Mat3 removed = direction * direction.transpose();
  fixed_ += added;
  free_ -= removed;
  if (rub_) {
    rub_->fixed += added;
    rub_->free -= removed;
  } else if (friction > 0) {
    rub_ = {normal, velocity, friction, fixed_, free_};
    if (sticks) stick();
  }
}

void Hold::stick() {
  rub_->sticks = true;
  rub_->impulse.setZero();
  fixed_ = rub_->velocity;
  free_.setZero();
}

std::optional<Hold::Change> Hold::settle(const Vec3& v, const Vec3& push) {
  if (!rub_) return std::nullopt;
  Rub& r = *rub_;
  const double most = r.friction * std::max(0.0, push.dot(r.normal));
  if (r.sticks) {
    const Vec3 across = push - r.normal * push.dot(r.normal);
    const double needed = across.norm();
    if (needed <= most) return std::nullopt;
    r.sticks = false;
    r.impulse = across * (most / needed);
    fixed_ = r.fixed;
    free_ = r.free;
    return Change{Vec3::Zero(), r.impulse};
  }
  const Vec3 relative = v - r.velocity;
  const Vec3 slip = relative - r.normal * relative.dot(r.normal);
  const double speed = slip.norm();
  const Vec3 before = r.impulse;
  // The friction would stop the node, or has turned it round.
  if (before.isZero(0) ? speed <= most : slip.dot(before) >= 0) {
    stick();
    return Change{-slip, -before};
  }
  r.impulse = slip * (-most / speed);
  return Change{Vec3::Zero(), r.impulse - before};
}

}  // namespace lather
