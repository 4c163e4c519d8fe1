// The longest step that the plan takes, at a safety factor of 1, holds for every model; how much longer a
// step may be before the run is unsound or ends with an error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <ostream>
#include <string>

#include "sim/plan/plan.h"
#include "sim/study/stability/extremes.h"
#include "sim/study/stability/invariants.h"

namespace lather::study {
namespace {

constexpr int kFrames = 10;
constexpr double kSteps = 1000;
constexpr double kLonger = 1.1;  // from one step tried to the next
constexpr double kLongest = 6;   // over the planned step

struct Case {
  Solver solver = Solver::kMpm;
  std::string model;
  int dimension = 2;
  std::string kernel = "cubic";  ///< of the grid solver
};

std::string name_of(const Case& c) {
  std::string name = (c.solver == Solver::kMpm ? "Mpm_" + c.kernel : std::string("Mlsrk")) + "_" + c.model +
                     "_" + std::to_string(c.dimension) + "D";
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
void PrintTo(const Case& c, std::ostream* out) {
  *out << name_of(c);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& model : extreme_models())
    for (const int dimension : {2, 3}) {
      for (const char* const kernel : {"cubic", "quadratic"})
        all.push_back({Solver::kMpm, model, dimension, kernel});
      all.push_back({Solver::kMlsrk, model, dimension, ""});
    }
  return all;
}

/// The block of the matrix of extremes with nothing extreme about it, but without any blend on the grid and
/// at a safety factor of 1.
Value block(const Case& c) {
  const std::map<std::string, int> chosen = {
      {"/dimension", c.dimension - 2},
      {"/numerics/kernel", c.kernel == "cubic" ? 1 : 0},
      {"/numerics/safety_factor", 2},
      {"/numerics/flip_blend", 2},
      {"/numerics/integration", 0},
      {"/numerics/transfer", 0},
      {"/numerics/precision", 0},
      {"/domain/boundary", 0},
      {"/materials/0/viscosity", c.model == "herschel-bulkley" ? 1 : 0},
      {"/materials/0/bulk_viscosity", 0},
      {"/materials/0/tear_threshold", 0},
      {"/materials/0/recovery_time", 0},
      {"/numerics/mlsrk/kernel_shape", 0},
      {"/numerics/mlsrk/inertial_mass", 0},
      {"/numerics/mlsrk/volume_correction", 0}};
  const std::vector<Factor> factors = extreme_factors(c.solver, c.model);
  Choice choice;
  for (const Factor& f : factors) {
    const auto found = chosen.find(f.name);
    choice.push_back(found == chosen.end() ? 1 : found->second);
  }
  return extreme_scene(c.solver, c.model, factors, choice, static_cast<int>(kSteps));
}

/// As long as kSteps steps of the planned length, in steps `longer` times as long.
Verdict run(const Case& c, double longer) {
  Value scene = block(c);
  const double step = make_plan(parse_scene(write_json(scene))).time_step;
  if (longer > 1) set_at_pointer(scene, "/numerics/time_step", longer * step);
  set_at_pointer(scene, "/duration", kSteps * step);
  set_at_pointer(scene, "/frame_rate", kFrames / (kSteps * step));
  return examine(parse_scene(write_json(scene)), {static_cast<std::uint64_t>(4 * kSteps)});
}

class StepBound : public testing::TestWithParam<Case> {};

TEST_P(StepBound, HoldsAtASafetyFactorOfOne) {
  double longer = 1;
  Verdict verdict = run(GetParam(), longer);
  ASSERT_EQ(verdict.outcome, Outcome::kHeld) << verdict.why;
  while (verdict.outcome == Outcome::kHeld && longer < kLongest) verdict = run(GetParam(), longer *= kLonger);
  std::printf("%s: %s %.2f times the planned step, %s\n", name_of(GetParam()).c_str(),
              verdict.outcome == Outcome::kHeld ? "holds at" : "fails at", longer, verdict.why.c_str());
}

INSTANTIATE_TEST_SUITE_P(Cases, StepBound, testing::ValuesIn(cases()),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace lather::study
