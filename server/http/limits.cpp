#include "server/http/limits.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "server/http/problem.h"
#include "sim/scene/value.h"
#include "sim/shape/shape.h"

namespace lather::server {
namespace {

// A body may fill little of its bounds, so the early estimate refuses only what is over by this factor.
constexpr double kEarlyMargin = 8;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 1e7 ? "%.0f" : "%.3g", value);
  return text;
}

std::uint64_t memory_limit(const JobLimits& limits) {
  if (limits.memory_bytes != 0) return limits.memory_bytes;
  const auto pages = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES));
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 10 * 9;
}

class Excesses {
 public:
  void check(const char* pointer, const char* what, double value, double most, const char* advice) {
    if (value <= most) return;
    problems_.push_back({pointer, number(value), "at most " + number(most) + ' ' + what,
                         std::string("the job would have ") + number(value) + ' ' + what +
                             ", this server takes " + number(most) + ": " + advice});
  }
  [[nodiscard]] bool any() const { return !problems_.empty(); }
  [[nodiscard]] HttpError error() const {
    return {422, "the job is larger than this server takes; its plan stands under 'plan'", problems_};
  }

 private:
  std::vector<Problem> problems_;
};

std::string plan_numbers(const Plan& plan) {
  const auto whole = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
  const Output& output = plan.scene.output;
  return write_json(
      Object{{"points", whole(plan.points)},
             {"frames", plan.frames},
             {"steps", whole(plan.steps)},
             {"time_step", plan.time_step},
             {"memory_bytes", whole(plan.memory_bytes)},
             {"point_steps", static_cast<double>(plan.points) * static_cast<double>(plan.steps)},
             {"width", output.width},
             {"height", output.height}});
}

/// Points if the shape filled its bounds.
double most_points_in(const Scene& scene, const Shape& shape) {
  const Box3 box = bounds(shape, scene.domain.box);
  const Vec3 extent = box.max.cwiseMin(scene.domain.box.max) - box.min.cwiseMax(scene.domain.box.min);
  double points = scene.points_per_cell;
  for (int axis = 0; axis < scene.dimension; ++axis)
    points *= std::ceil(std::max(0.0, extent[axis]) / scene.spacing);
  return points;
}

/// Points if every body and every emitter's shape filled its bounds once.
double most_points(const Scene& scene) {
  double points = 0;
  for (const Body& body : scene.bodies) points += most_points_in(scene, *body.shape);
  for (const Emitter& emitter : scene.emitters) points += most_points_in(scene, *emitter.shape);
  return points;
}

}  // namespace

void check_before_planning(const Scene& scene, const JobLimits& limits) {
  const double points = most_points(scene);
  Excesses excesses;
  if (points > kEarlyMargin * static_cast<double>(limits.points))
    excesses.check("/spacing", "points", points, static_cast<double>(limits.points),
                   "choose a larger spacing");
  const double frames = std::floor(scene.duration * scene.frame_rate) + 1;
  excesses.check("/frame_rate", "frames", frames, limits.frames, "shorten duration or lower frame_rate");
  if (!excesses.any()) return;
  throw excesses.error().with("plan", write_json(Object{{"points_at_most", points}, {"frames", frames}}));
}

void check_pictures(const Output& output, const JobLimits& limits) {
  Excesses excesses;
  excesses.check("/output", "pixels a frame", static_cast<double>(output.width) * output.height,
                 static_cast<double>(limits.pixels), "choose a smaller width and height");
  if (excesses.any()) throw excesses.error();
}

void check_plan(const Plan& plan, const JobLimits& limits) {
  const double points = static_cast<double>(plan.points);
  const Output& output = plan.scene.output;
  Excesses excesses;
  excesses.check("/spacing", "points", points, static_cast<double>(limits.points), "choose a larger spacing");
  excesses.check("/frame_rate", "frames", plan.frames, limits.frames, "shorten duration or lower frame_rate");
  excesses.check("/output", "pixels a frame", static_cast<double>(output.width) * output.height,
                 static_cast<double>(limits.pixels), "choose a smaller width and height");
  excesses.check("/spacing", "bytes of memory", static_cast<double>(plan.memory_bytes),
                 static_cast<double>(memory_limit(limits)), "choose a larger spacing");
  excesses.check("/spacing", "points times steps", points * static_cast<double>(plan.steps),
                 limits.point_steps, "choose a larger spacing, a shorter duration or a softer material");
  if (excesses.any()) throw excesses.error().with("plan", plan_numbers(plan));
}

}  // namespace lather::server
