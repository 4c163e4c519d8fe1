// Every law in the grid solver: points that follow a grid whose velocity is linear see exactly its gradient,
// so that what a law makes of a history of gradients is known, and with it the forces that they give back.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "sim/plan/law_constants.h"
#include "sim/plan/planned_fields.h"
#include "tests/support/kernel_levels.h"
#include "tests/unit/sim/material/plastic_laws.h"
#include "tests/unit/sim/mpm/block_sample.h"

namespace lather {
namespace {

using namespace testing_support;

constexpr int kSteps = 60;

/// Of step n, 1/s: everything is squeezed along x and sheared, then drawn out again, not quite as far.
Mat3 gradient_at(int n, int dimension) {
  Mat3 L = Mat3::Zero();
  const double phase = 2 * M_PI * n / kSteps;
  L(0, 0) = -1 - 6 * std::sin(phase);
  L(1, 1) = 2 * std::sin(phase);
  L(0, 1) = 4 * std::cos(phase);
  L(1, 0) = -1.5;
  if (dimension == 3) {
    L(2, 2) = 3 * std::sin(2 * phase);
    L(0, 2) = 2;
    L(2, 1) = -3 * std::cos(2 * phase);
  }
  return L;
}

/// One point that all of this happens to, in plain double matrices.
struct Reference {
  int dimension;
  Mat3 F = Mat3::Identity();  // F_e where the law yields
  double J_p = 1;
  Mat3 L = Mat3::Zero();  // the last one

  void deform(const Mat3& gradient) {
    L = gradient;
    F = (Mat3::Identity() + kStep * L) * F;
  }
  /// The return mapping, in principal stretches.
  void yield(const LogMap& map) {
    const Tensor in_space = F.topLeftCorner(dimension, dimension);
    const Eigen::JacobiSVD<Tensor> svd(in_space, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const MappedLogs after = map(svd.singularValues().array().log(), J_p);
    F.topLeftCorner(dimension, dimension) =
        svd.matrixU() * after.log.exp().matrix().asDiagonal() * svd.matrixV().transpose();
    J_p = after.J_p;
  }
  /// [MLSRK eq. 22, 25]
  [[nodiscard]] Mat3 elastic(const ElasticParameters& p, double xi) const {
    const double log_J = std::log(F.determinant());
    return std::exp(xi * (1 - J_p)) * (p.lame_mu() * (F * F.transpose() - Mat3::Identity()) +
                                       p.lame_lambda() * log_J * Mat3::Identity());
  }
  /// J sigma_v [MLSRK eq. 23]
  [[nodiscard]] Mat3 viscous(const ViscousParameters& p) const {
    Mat3 sigma = p.viscosity * (L + L.transpose());
    for (int a = 0; a < dimension; ++a)
      sigma(a, a) += (p.bulk_viscosity - 2 * p.viscosity / dimension) * L.trace();
    return F.determinant() * J_p * sigma;
  }
};

/// Follows the history and says the Kirchhoff stress at its end.
struct StressAfter {
  int dimension;

  Mat3 operator()(const HerschelBulkleyParameters&) const { return Mat3::Zero(); }  // has tests of its own
  Mat3 operator()(const NeoHookeanParameters& p) const {
    const Reference r = after([](Reference&) {});
    return r.elastic(p.elastic, 0) + r.viscous(p.viscous);
  }
  Mat3 operator()(const SnowParameters& p) const {
    const Reference r = after([&](Reference& point) { point.yield(referee(p)); });
    return r.elastic(p.elastic, p.hardening);
  }
  Mat3 operator()(const DruckerPragerParameters& p) const {
    const Reference r = after([&](Reference& point) { point.yield(referee(p, dimension)); });
    return r.elastic(p.elastic, p.hardening) + r.viscous(p.viscous);
  }
  Mat3 operator()(const LiquidParameters& p) const {
    const Reference r = after([](Reference&) {});
    const double J = r.F.determinant();
    const double pressure = std::max(0.0, p.bulk_modulus / p.exponent * (std::pow(J, -p.exponent) - 1));
    return r.viscous(p.viscous) - J * pressure * Mat3::Identity();
  }

 private:
  template <class Yield>
  [[nodiscard]] Reference after(const Yield& yield) const {
    Reference r{dimension};
    for (int n = 0; n < kSteps; ++n) {
      r.deform(gradient_at(n, dimension));
      yield(r);
    }
    return r;
  }
};

/// Gives the sample's points another law.
void take_law(Sample& s, const Law& law, KernelLevel level) {
  Scene scene;
  scene.dimension = s.dimension;
  scene.numerics.transfer = s.apic ? lather::Transfer::kApic : lather::Transfer::kFlip;
  Material material;
  material.law = law;
  ParticleSet<double> set(s.dimension, planned_fields(scene, material), Vec3::Zero(), kCell);
  s.for_points([&](std::size_t t, int lane) {
    set.add(s.set.position(t, lane), s.set.velocity(t, lane), s.affine(t, lane),
            s.set.values<std::uint32_t>(t, Field::kId)[lane]);
  });
  set.sort({s.dimension, {12, 12, 12}, {}, false}, 1);
  s.set = std::move(set);
  s.material.law = law_constants<double>(law, s.dimension);
  s.material.most_opened = 3;
  s.material.kernels = mpm::kernel_table<double>(level).laws[s.dimension - 2][law.index()];
}

/// Lets the points follow the history of gradients, without moving them.
void follow_history(Sample& s) {
  for (int n = 0; n < kSteps; ++n) {
    std::vector<double> velocity(s.momentum.size(), 0);
    const std::vector<double> increment(s.momentum.size(), 0);
    s.for_nodes([&](std::size_t q, const Vec3& node) {
      const Vec3 v = gradient_at(n, s.dimension) * node;
      for (int a = 0; a < s.dimension; ++a) velocity[q + 1 + static_cast<std::size_t>(a)] = v[a];
    });
    s.kernels.gather(s.points(), s.place(), s.step(), velocity.data(), increment.data());
  }
}

/// The forces that points under `tau` give each node, against those of the kernel.
void expect_forces(Sample& s, const Mat3& tau) {
  s.kernels.scatter(s.points(), s.place(), s.step(), s.momentum.data(), s.force.data());
  double largest = 0;
  double error = 0;
  s.for_nodes([&](std::size_t q, const Vec3& node) {
    Vec3 f = Vec3::Zero();
    Vec3 p = Vec3::Zero();
    s.for_points([&](std::size_t t, int lane) {
      const Vec3 from = node - s.set.position(t, lane);
      f -= s.material.volume * tau * s.weight_gradient(from);
      p += s.weight(from) * s.material.mass * (s.set.velocity(t, lane) + s.affine(t, lane) * from);
    });
    largest = std::max(largest, f.norm());
    for (int a = 0; a < s.dimension; ++a) {
      const std::size_t c = q + 1 + static_cast<std::size_t>(a);
      const double got = s.apic ? (s.momentum[c] - p[a]) / kStep : s.force[c];
      error = std::max(error, std::abs(got - f[a]));
    }
  });
  ASSERT_GT(largest, 0);
  // 60 steps of rounding, which stiff laws multiply: moduli over the stress at hand are below 1e3. With APIC
  // the impulse is what two sums differ by.
  EXPECT_LT(error, 1e-9 * largest) << "of " << largest;
}

NeoHookeanParameters jelly() {
  NeoHookeanParameters p;
  p.elastic = {1000, 1e5, 0.3};
  return p;
}
NeoHookeanParameters slow_jelly() {
  NeoHookeanParameters p = jelly();
  p.viscous = {300, 200};
  return p;
}
DruckerPragerParameters mud() {
  DruckerPragerParameters p = grains()[1];
  p.viscous = {500, 400};
  p.hardening = 5;
  return p;
}
LiquidParameters water() {
  LiquidParameters p;
  p.density = 1000;
  p.bulk_modulus = 1e5;
  return p;
}
LiquidParameters syrup() {
  LiquidParameters p = water();
  p.viscous = {50, 20};
  return p;
}

struct Case {
  const char* name;
  Law law;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class LawInTheGrid : public testing::TestWithParam<Case> {};

TEST_P(LawInTheGrid, GivesTheForcesOfItsStressAfterAHistoryOfGradients) {
  for (const KernelLevel level : levels_here())
    for_variants(level, [&](Sample& s) {
      take_law(s, GetParam().law, level);
      follow_history(s);
      expect_forces(s, std::visit(StressAfter{s.dimension}, GetParam().law));
    });
}

INSTANTIATE_TEST_SUITE_P(Laws, LawInTheGrid,
                         testing::Values(Case{"NeoHookean", jelly()}, Case{"ViscousNeoHookean", slow_jelly()},
                                         Case{"Snow", snow()}, Case{"Sand", grains()[0]},
                                         Case{"CohesiveViscousMud", mud()}, Case{"Water", water()},
                                         Case{"Syrup", syrup()}),
                         [](const auto& test) { return std::string(test.param.name); });

// A point that flies alone keeps its velocity gradient: for e^9 times its volume here.
TEST(LawInTheGrid, OpensAPointThatBearsNoTensionNoFurtherThanItsCell) {
  const std::vector<std::pair<Law, Field>> opened = {
      {water(), Field::kVolumeChange}, {grains()[0], Field::kPlasticVolume}, {snow(), Field::kPlasticVolume}};
  for (const auto& [law, field] : opened) {
    Sample s(3, true, true, best_kernel_level());
    take_law(s, law, best_kernel_level());
    for (int n = 0; n < kSteps; ++n) {
      s.for_nodes([&](std::size_t q, const Vec3& node) {
        for (int a = 0; a < 3; ++a) s.momentum[q + 1 + static_cast<std::size_t>(a)] = 50 * node[a];
      });
      s.kernels.gather(s.points(), s.place(), s.step(), s.momentum.data(), nullptr);
    }
    EXPECT_EQ(s.set.values<double>(0, field)[0], 3);
  }
}

// What the planned step must be shortened by.
TEST(LawInTheGrid, ReportsTheFactorByWhichSnowHasHardened) {
  const SnowParameters p = snow();
  Sample s(3, true, false, best_kernel_level());
  take_law(s, p, best_kernel_level());
  const auto scatter = [&] {
    return s.kernels.scatter(s.points(), s.place(), s.step(), s.momentum.data(), s.force.data());
  };
  EXPECT_EQ(scatter(), 1);
  s.set.values<double>(1, Field::kPlasticVolume)[3] = -0.2;
  s.set.values<double>(0, Field::kPlasticVolume)[7] = 0.1;  // softened
  EXPECT_NEAR(scatter(), std::exp(0.2 * p.hardening), 1e-12);
}

}  // namespace
}  // namespace lather
