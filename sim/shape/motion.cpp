#include "sim/shape/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/shape/placement.h"

namespace lather {
namespace {

/// Seconds that a motion has run at time t.
double elapsed(double t, double start, double end) {
  return std::clamp(t - start, 0.0, std::max(end - start, 0.0));
}

bool runs_at(double t, double start, double end) {
  return t >= start && t < end;
}

bool runs_within(double duration, double start, double end) {
  return start <= duration && end > 0 && end > start;
}

double phase_at(const Oscillation& m, double run) {
  return 2 * M_PI * m.frequency * run + radians(m.phase_deg);
}

/// Placement and its rate of change: R = Rz Ry Rx, angles in degrees.
struct Sample {
  Vec3 translate = Vec3::Zero();
  Vec3 rotate_deg = Vec3::Zero();
  Vec3 translate_rate = Vec3::Zero();   // m/s
  Vec3 rotate_rate_deg = Vec3::Zero();  // degrees/s
};

/// Catmull-Rom: the slope of the chord over both neighbours; at an end, of the only chord.
Vec3 tangent(const std::vector<Keyframe>& keys, std::size_t i, Vec3 Keyframe::*value) {
  const Keyframe& before = keys[i == 0 ? 0 : i - 1];
  const Keyframe& after = keys[std::min(i + 1, keys.size() - 1)];
  return (after.*value - before.*value) / (after.time - before.time);
}

/// Cubic Hermite of one segment at u in [0, 1]; `width` is its length in seconds.
struct Segment {
  Vec3 p0, p1, m0, m1;
  double width;

  [[nodiscard]] Vec3 value(double u) const {
    const double v = 1 - u;
    return v * v * (1 + 2 * u) * p0 + u * u * (3 - 2 * u) * p1 + width * u * v * (v * m0 - u * m1);
  }
  /// The rate is a quadratic Bezier curve with these control points, so their hull holds it.
  [[nodiscard]] Vec3 middle_control() const { return 3 * (p1 - p0) / width - m0 - m1; }
  [[nodiscard]] Vec3 rate(double u) const {
    const double v = 1 - u;
    return v * v * m0 + 2 * u * v * middle_control() + u * u * m1;
  }
};

Segment segment(const std::vector<Keyframe>& keys, std::size_t i, Vec3 Keyframe::*value) {
  return {keys[i].*value, keys[i + 1].*value, tangent(keys, i, value), tangent(keys, i + 1, value),
          keys[i + 1].time - keys[i].time};
}

Sample sample(const Keyframes& m, double t) {
  Sample out;
  if (m.keys.empty()) return out;
  const Keyframe& first = m.keys.front();
  const Keyframe& last = m.keys.back();
  if (t < first.time || t >= last.time) {
    const Keyframe& held = t < first.time ? first : last;
    out.translate = held.translate;
    out.rotate_deg = held.rotate_deg;
    return out;
  }
  std::size_t i = 0;
  while (t >= m.keys[i + 1].time) ++i;
  const Segment move = segment(m.keys, i, &Keyframe::translate);
  const Segment turn = segment(m.keys, i, &Keyframe::rotate_deg);
  const double u = (t - m.keys[i].time) / move.width;
  out.translate = move.value(u);
  out.rotate_deg = turn.value(u);
  out.translate_rate = move.rate(u);
  out.rotate_rate_deg = turn.rate(u);
  return out;
}

/// Angular velocity of R = Rz Ry Rx, rad/s: every angle turns about its axis as the later rotations carry it.
Vec3 angular_velocity(const Sample& s) {
  const Mat3 rz = rotation_of({0, 0, s.rotate_deg.z()});
  const Mat3 ry = rotation_of({0, s.rotate_deg.y(), 0});
  const Vec3 rate = s.rotate_rate_deg * (M_PI / 180);
  return rate.z() * Vec3::UnitZ() + rz * (rate.y() * Vec3::UnitY() + ry * (rate.x() * Vec3::UnitX()));
}

struct PoseAt {
  double t;

  Pose operator()(const AtRest&) const { return {}; }
  Pose operator()(const LinearMotion& m) const {
    return {Quat::Identity(), m.velocity * elapsed(t, m.start, m.end)};
  }
  Pose operator()(const Oscillation& m) const {
    const double run = elapsed(t, m.start, m.end);
    const double shift = m.amplitude * (std::sin(phase_at(m, run)) - std::sin(phase_at(m, 0)));
    return {Quat::Identity(), shift * m.direction.normalized()};
  }
  Pose operator()(const Rotation& m) const {
    const double angle = radians(m.rate_deg) * elapsed(t, m.start, m.end);
    const Quat turn(Eigen::AngleAxisd(angle, m.axis.normalized()));
    return {turn, m.center - turn * m.center};
  }
  Pose operator()(const Keyframes& m) const {
    const Sample s = sample(m, t);
    return {Quat(rotation_of(s.rotate_deg)), s.translate};
  }
};

struct VelocityAt {
  double t;
  const Vec3& x;

  Vec3 operator()(const AtRest&) const { return Vec3::Zero(); }
  Vec3 operator()(const LinearMotion& m) const {
    return runs_at(t, m.start, m.end) ? m.velocity : Vec3(Vec3::Zero());
  }
  Vec3 operator()(const Oscillation& m) const {
    if (!runs_at(t, m.start, m.end)) return Vec3::Zero();
    const double speed = 2 * M_PI * m.frequency * m.amplitude * std::cos(phase_at(m, t - m.start));
    return speed * m.direction.normalized();
  }
  Vec3 operator()(const Rotation& m) const {
    if (!runs_at(t, m.start, m.end)) return Vec3::Zero();
    return radians(m.rate_deg) * m.axis.normalized().cross(x - m.center);
  }
  Vec3 operator()(const Keyframes& m) const {
    const Sample s = sample(m, t);
    return s.translate_rate + angular_velocity(s).cross(x - s.translate);
  }
};

struct MaxSpeed {
  const Vec3& center;
  double radius;
  double duration;

  double operator()(const AtRest&) const { return 0; }
  double operator()(const LinearMotion& m) const {
    return runs_within(duration, m.start, m.end) ? m.velocity.norm() : 0;
  }
  double operator()(const Oscillation& m) const {
    return runs_within(duration, m.start, m.end) ? std::abs(2 * M_PI * m.frequency * m.amplitude) : 0;
  }
  double operator()(const Rotation& m) const {
    if (!runs_within(duration, m.start, m.end)) return 0;
    const double arm = m.axis.normalized().cross(center - m.center).norm() + radius;
    return std::abs(radians(m.rate_deg)) * arm;
  }
  double operator()(const Keyframes& m) const {
    double fastest = 0;
    const double arm = center.norm() + radius;
    for (std::size_t i = 0; i + 1 < m.keys.size(); ++i) {
      if (m.keys[i + 1].time <= 0 || m.keys[i].time > duration) continue;
      const Segment move = segment(m.keys, i, &Keyframe::translate);
      const Segment turn = segment(m.keys, i, &Keyframe::rotate_deg);
      const double shift = std::max({move.m0.norm(), move.middle_control().norm(), move.m1.norm()});
      const double spin =
          std::max({turn.m0.lpNorm<1>(), turn.middle_control().lpNorm<1>(), turn.m1.lpNorm<1>()});
      fastest = std::max(fastest, shift + radians(spin) * arm);
    }
    return fastest;
  }
};

}  // namespace

Pose pose_at(const Motion& motion, double t) {
  return std::visit(PoseAt{t}, motion);
}

Vec3 velocity_at(const Motion& motion, double t, const Vec3& x) {
  return std::visit(VelocityAt{t, x}, motion);
}

double max_speed(const Motion& motion, const Vec3& center, double radius, double duration) {
  return std::visit(MaxSpeed{center, radius, duration}, motion);
}

}  // namespace lather
