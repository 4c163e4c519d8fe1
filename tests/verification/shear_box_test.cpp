// Start-up of simple shear in an MPM box: periodic in x and z, moving adhesive walls, started from v = rate
// y, stress read in the middle half. The law must come out of the whole method as it went in.
//
// The walls are stacks of sheets, one to a layer of nodes, each with the speed that the flow would have
// there. A single rigid wall acts as if it stood 0.65 cells behind its first node, whatever the gap (cubic
// kernels; measured from the stress at gaps of 13 and 25 cells), which would change the shear rate by 10 % at
// this gap and hide what is tested.

#include <gtest/gtest.h>

#include <cmath>

#include "sim/mpm/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/step_bound.h"
#include "tests/support/reference_data.h"

namespace lather {
namespace {

using testing_support::SimpleShearRun;

constexpr int kGap = 12;  ///< cells between the innermost wall nodes

/// Double precision: oobleck at 0.1/s carries 0.09 Pa beside a bulk modulus of 10^5 Pa; float's noise of J
/// alone is 2 % of that. Density and bulk modulus do not enter the exact solution (v = rate y is steady, J =
/// 1). The cell width is chosen so that a stable step shears by about `increment`: a scene of the law's own
/// time scale.
Scene box_scene(const SimpleShearRun& run, double increment) {
  const double density = 77.7;
  const double kappa = std::max(20 * run.mu, 2000.0);
  const double c = std::sqrt((kappa + 4.0 / 3.0 * run.mu) / density);
  const double h = increment / run.shear_rate * c / 0.3;
  const auto number = [](double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return std::string(text);
  };
  std::string walls;
  for (const int side : {-1, 1})
    for (int layer = kGap / 2; layer < kGap / 2 + 4; ++layer) {
      const double y = side * layer * h;
      if (!walls.empty()) walls += ',';
      walls += R"({"name": "sheet )" + std::to_string(side * layer) +
               R"(", "shape": {"type": "box", "size": [)" + number(100 * h) + "," + number(0.2 * h) + "," +
               number(100 * h) + R"(], "translate": [0,)" + number(y) +
               R"(, 0]}, "adhesive": true, "motion": {"type": "linear", "velocity": [)" +
               number(run.shear_rate * y) + ", 0, 0]}}";
    }
  // The slab reaches 3 cells into each wall, so that the kernels of all free nodes are full.
  const std::string json =
      R"({"lather": 1, "name": "box", "domain": {"min": [)" + number(-2 * h) + "," + number(-12 * h) + "," +
      number(-2 * h) + R"(], "max": [)" + number(2 * h) + "," + number(12 * h) + "," + number(2 * h) +
      R"(], "periodic": [true, false, true]}, "gravity": [0,0,0], "duration": 1e6, "frame_rate": 1e-6, "spacing": )" +
      number(h) + R"(, "materials": [{"name": "m", "density": )" + number(density) + R"(, "bulk_modulus": )" +
      number(kappa) + R"(, "shear_modulus": )" + number(run.mu) + R"(, "yield_stress": )" +
      number(run.sigma_y) + R"(, "viscosity": )" + number(run.eta) + R"(, "flow_index": )" + number(run.h) +
      R"(}], "bodies": [{"name": "slab", "material": "m", "shape": {"type": "box", "size": [)" +
      number(10 * h) + "," + number(18 * h) + "," + number(10 * h) + R"(]}, "velocity_gradient": [[0,)" +
      number(run.shear_rate) + R"(,0],[0,0,0],[0,0,0]]}], "obstacles": [)" + walls +
      R"(], "numerics": {"transfer": "apic", "precision": "double"}})";
  return parse_scene(json);
}

struct Stresses {
  double tau_xy = 0;
  double n1 = 0;
  double s = 0;
};

/// Mean Kirchhoff stresses over the points of the middle half of the gap.
Stresses middle_stress(const mpm::State<double>& state, const Scene& scene,
                       const mpm::PointKernels<double>& kernels,
                       const HerschelBulkleyConstants<double>& law) {
  const ParticleSet<double>& set = state.sets[0];
  Stresses sum;
  double count = 0;
  for (std::size_t t = 0; t < set.tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane) {
      if (set.values<std::uint32_t>(t, Field::kId)[lane] == kNoPoint) continue;
      if (std::abs(set.position(t, lane).y()) >= kGap / 4.0 * scene.spacing) continue;
      double point[7] = {set.values<double>(t, Field::kVolumeChange)[lane]};
      for (int c = 0; c < 6; ++c) point[1 + c] = set.values<double>(t, Field::kElasticStrain, c)[lane];
      double tau[6];
      kernels.stress(law, point, tau);
      const double p = (tau[0] + tau[1] + tau[2]) / 3.0;
      double s2 = 0;
      for (int a = 0; a < 3; ++a) s2 += (tau[a] - p) * (tau[a] - p) + 2.0 * tau[3 + a] * tau[3 + a];
      sum.tau_xy += tau[3];
      sum.n1 += tau[0] - tau[1];
      sum.s += std::sqrt(s2);
      ++count;
    }
  return {sum.tau_xy / count, sum.n1 / count, sum.s / count};
}

class ShearBox : public testing::TestWithParam<SimpleShearRun> {};

TEST_P(ShearBox, StressesFollowTheReferenceWithinTwoPercent) {
  const SimpleShearRun& run = GetParam();
  const Scene scene = box_scene(run, 5e-4);
  const Plan plan = make_plan(scene);
  const mpm::Model<double> model(plan);
  mpm::State<double> state;
  state.sets.emplace_back(3, planned_fields(scene, scene.materials[0]), scene.domain.box.min, scene.spacing);
  seed_points(scene,
              [&](const Seed& s) { state.sets[0].add(s.position, s.velocity, s.velocity_gradient, s.id); });
  ASSERT_GT(state.sets[0].size(), 1000U);
  mpm::Stepper<double> stepper(model, 1);
  const auto& kernels = mpm::kernel_table<double>(plan.choices.kernel_level).point;
  const double bound = 0.02 * run.largest_s();
  for (std::size_t i = 1; i < run.t.size(); ++i) {
    const double span = run.t[i] - run.t[i - 1];
    const double steps = steps_for(span, planned_step(scene));
    for (int n = 0; n < static_cast<int>(steps); ++n) ASSERT_TRUE(stepper.step(state, span / steps).finite);
    const Stresses got = middle_stress(state, scene, kernels, model.materials[0].law);
    EXPECT_NEAR(got.tau_xy, run.tau_xy[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.n1, run.n1[i], bound) << "t = " << run.t[i];
    EXPECT_NEAR(got.s, run.s[i], bound) << "t = " << run.t[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, ShearBox, testing::ValuesIn(testing_support::simple_shear_runs()),
                         [](const auto& test) { return "Run" + std::to_string(test.index); });

}  // namespace
}  // namespace lather
