#include "sim/study/rheometer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/error.h"
#include "sim/material/herschel_bulkley_make.h"
#include "sim/mpm/levels.h"
#include "sim/study/colon_numbers.h"

namespace lather::study {
namespace {

constexpr double kLargestIncrement = 1e-4;  // shear of one step of the law
constexpr double kBlock = 0.1;              // shear between two looks for steadiness
constexpr double kSteady = 1e-6;            // largest change over a block, of s
constexpr double kLongestFlow = 200;        // shear after which a flow is given up as unsteady

std::string text_of(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// One material point in simple shear.
class ShearedPoint {
 public:
  explicit ShearedPoint(const HerschelBulkleyParameters& law)
      : kernels_(mpm::kernel_table<double>(best_kernel_level()).point),
        law_(herschel_bulkley_constants<double>(law)) {}

  /// Shears at `rate` (1/s) for `time` (s) in equal steps of at most kLargestIncrement.
  void shear(double rate, double time) {
    const double steps = std::max(1.0, std::ceil(rate * time / kLargestIncrement * (1 - 1e-9)));
    const double dt = time / steps;
    const double A[9] = {0, rate * dt, 0, 0, 0, 0, 0, 0, 0};
    for (double n = 0; n < steps; ++n) kernels_.law_step(law_, A, dt, state_);
  }

  [[nodiscard]] ShearStress stress() const {
    double tau[6];
    kernels_.stress(law_, state_, tau);
    return shear_stress(tau);
  }

 private:
  const mpm::PointKernels<double>& kernels_;
  HerschelBulkleyConstants<double> law_;
  double state_[7] = {};
};

SteadyFlow steady_flow(const HerschelBulkleyParameters& law, double rate) {
  ShearedPoint point(law);
  ShearStress before;
  for (double shear = 0; shear < kLongestFlow; shear += kBlock) {
    point.shear(rate, kBlock / rate);
    const ShearStress now = point.stress();
    const double change = std::max(std::abs(now.tau_xy - before.tau_xy), std::abs(now.n1 - before.n1));
    if (change <= kSteady * now.s) return {rate, now, true};
    before = now;
  }
  return {rate, before, false};
}

[[noreturn]] void refuse_range(const std::string& text, const std::string& why) {
  throw InputError(
      {{"", "--rates " + text,
        "LOWEST:HIGHEST or LOWEST:HIGHEST:COUNT, 0 < lowest < highest in 1/s, count from 2 to 1000", why}});
}

}  // namespace

void check(const StartUpRequest& r, double most_shear) {
  std::vector<Problem> problems;
  if (!(r.rate > 0 && std::isfinite(r.rate)))
    problems.push_back({"", "--rate " + text_of(r.rate), "above 0 1/s", "This is no rate of shear."});
  if (!(r.time > 0 && std::isfinite(r.time)))
    problems.push_back({"", "--time " + text_of(r.time), "above 0 s", "This is no length of time."});
  if (r.steps < 1 || r.steps > kMostReadings)
    problems.push_back({"", "--steps " + std::to_string(r.steps),
                        "from 1 to " + std::to_string(kMostReadings),
                        "The curve cannot have so many readings."});
  if (problems.empty() && r.rate * r.time > most_shear)
    problems.push_back({"", "rate x time = " + text_of(r.rate * r.time), "at most " + text_of(most_shear),
                        "The material would be sheared too far; shorten --time to " +
                            text_of(most_shear / r.rate) + " s or less."});
  if (!problems.empty()) throw InputError(std::move(problems));
}

StartUp start_up(const HerschelBulkleyParameters& law, const StartUpRequest& request) {
  check(request);
  ShearedPoint point(law);
  StartUp out;
  out.rate = request.rate;
  out.t.push_back(0);
  out.stress.push_back(point.stress());
  const auto steps = static_cast<int>(request.steps);
  for (int i = 1; i <= steps; ++i) {
    point.shear(request.rate, request.time / steps);
    out.t.push_back(request.time * i / steps);
    out.stress.push_back(point.stress());
  }
  return out;
}

RateRange read_rate_range(const std::string& text) {
  const std::vector<double> numbers = numbers_between_colons(text);
  if (numbers.size() != 2 && numbers.size() != 3) refuse_range(text, "These are no rates.");
  RateRange range;
  range.lowest = numbers[0];
  range.highest = numbers[1];
  if (!(range.lowest > 0 && range.highest > range.lowest && std::isfinite(range.highest)))
    refuse_range(text, "The rates must be above 0, the lowest first.");
  const double decades = std::log10(range.highest / range.lowest);
  const double count = numbers.size() == 3 ? numbers[2] : std::ceil(5 * decades - 1e-9) + 1;
  if (!(count >= 2 && count <= 1000 && count == std::floor(count)))
    refuse_range(text, "The curve cannot have " + text_of(count) + " rates.");
  range.count = static_cast<int>(count);
  return range;
}

std::vector<SteadyFlow> flow_curve(const HerschelBulkleyParameters& law, const RateRange& range) {
  if (!std::isfinite(law.yield_stress))
    throw InputError({{"/yield_stress", "infinity", "a finite yield stress, Pa",
                       "A material that never yields has no flow curve; leave out --rates to see its elastic "
                       "start-up, or give it a yield_stress."}});
  std::vector<SteadyFlow> curve;
  for (int i = 0; i < range.count; ++i) {
    const double part = static_cast<double>(i) / (range.count - 1);
    curve.push_back(steady_flow(law, range.lowest * std::pow(range.highest / range.lowest, part)));
  }
  return curve;
}

}  // namespace lather::study
