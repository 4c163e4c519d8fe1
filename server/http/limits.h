#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/plan/plan.h"

namespace lather::server {

/// What one job may ask of this server.
struct JobLimits {
  std::uint64_t points = 20'000'000;
  int frames = 20'000;
  std::uint64_t pixels = 33'177'600;  ///< of a picture: 7680 x 4320
  std::uint64_t memory_bytes = 0;     ///< 0: nine tenths of the machine's
  double point_steps = 2e13;          ///< points times expected steps: a month at 1e7 a second
};

/// Refuses (HttpError 422, with an estimate) a scene whose planning alone would cost too much: judged from
/// the bodies' bounds, before any point is made.
void check_before_planning(const Scene& scene, const JobLimits& limits);

/// Refuses (HttpError 422, with the plan's numbers) a plan beyond the limits, naming each one.
void check_plan(const Plan& plan, const JobLimits& limits);

/// Refuses (HttpError 422) pictures beyond the limits.
void check_pictures(const Output& output, const JobLimits& limits);

}  // namespace lather::server
