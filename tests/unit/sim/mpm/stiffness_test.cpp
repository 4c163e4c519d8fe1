// The operator of the semi-implicit step against finite differences of the explicit force, and its symmetry.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/kernel_levels.h"
#include "tests/unit/sim/mpm/block_sample.h"

namespace lather {
namespace {

using namespace testing_support;

constexpr mpm::StiffnessTerms<double> kWhole{0, 1, 1, 0};

/// Makes det(I + B) = 1 at all points, as it is in a run: a step of the law that deforms nothing.
void normalize_strains(Sample& s) {
  const double still[9] = {};
  s.for_points([&](std::size_t t, int lane) {
    double state[7] = {s.set.values<double>(t, Field::kVolumeChange)[lane]};
    const int count = s.dimension == 3 ? 6 : 4;
    for (int c = 0; c < count; ++c) state[1 + c] = s.set.values<double>(t, Field::kElasticStrain, c)[lane];
    s.table.point.law_step(s.material.law.herschel_bulkley, still, kStep, state);
    for (int c = 0; c < count; ++c) s.set.values<double>(t, Field::kElasticStrain, c)[lane] = state[1 + c];
  });
}

/// Some velocity at every node of the buffer, quads of (0, v); `seed` makes them differ.
std::vector<double> node_velocities(const Sample& s, unsigned seed) {
  std::vector<double> v(static_cast<std::size_t>(mpm::buffer_reals(s.dimension)), 0);
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  s.for_nodes([&](std::size_t q, const Vec3&) {
    for (int a = 0; a < s.dimension; ++a) v[q + 1 + static_cast<std::size_t>(a)] = value(rng);
  });
  return v;
}

std::vector<double> impulse(Sample& s, const mpm::StiffnessTerms<double>& terms,
                            const std::vector<double>& velocity) {
  std::vector<double> p(velocity.size(), 0);
  s.kernels.stiffness(s.points(), s.place(), s.step(), terms, velocity.data(), p.data());
  return p;
}

/// dt f_i of the explicit step after the nodes have moved by e dt v: -dt sum V tau(f F) f^-T grad w_i with
/// f = I + e dt grad v, by the law's own functions.
std::vector<double> moved_impulse(Sample& s, const std::vector<double>& velocity, double e) {
  std::vector<double> p(velocity.size(), 0);
  s.for_points([&](std::size_t t, int lane) {
    const Vec3 x = s.set.position(t, lane);
    Mat3 A = Mat3::Zero();
    s.for_nodes([&](std::size_t q, const Vec3& node) {
      const Vec3 g = s.weight_gradient(node - x);
      for (int a = 0; a < s.dimension; ++a)
        A.row(a) += e * kStep * velocity[q + 1 + static_cast<std::size_t>(a)] * g.transpose();
    });
    double state[7] = {s.set.values<double>(t, Field::kVolumeChange)[lane]};
    for (int c = 0; c < (s.dimension == 3 ? 6 : 4); ++c)
      state[1 + c] = s.set.values<double>(t, Field::kElasticStrain, c)[lane];
    double rows[9];
    for (int i = 0; i < 9; ++i) rows[i] = A(i / 3, i % 3);
    s.table.point.law_step(s.material.law.herschel_bulkley, rows, kStep, state);
    double stress[6];
    s.table.point.stress(s.material.law.herschel_bulkley, state, stress);
    Mat3 tau;
    tau << stress[0], stress[3], stress[4], stress[3], stress[1], stress[5], stress[4], stress[5], stress[2];
    const Mat3 sigma = tau * (Mat3::Identity() + A).inverse().transpose();
    s.for_nodes([&](std::size_t q, const Vec3& node) {
      const Vec3 f = -s.material.volume * sigma * s.weight_gradient(node - x);
      for (int a = 0; a < s.dimension; ++a) p[q + 1 + static_cast<std::size_t>(a)] += kStep * f[a];
    });
  });
  return p;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double largest(const std::vector<double>& a) {
  double most = 0;
  for (const double x : a) most = std::max(most, std::abs(x));
  return most;
}

class Stiffness : public testing::TestWithParam<KernelLevel> {};

TEST_P(Stiffness, IsTheDerivativeOfTheExplicitForce) {
  for_variants(GetParam(), [](Sample& s) {
    normalize_strains(s);
    const std::vector<double> v = node_velocities(s, 3);
    const std::vector<double> found = impulse(s, kWhole, v);
    // Central differences: an error of e^2 |A|^2 with |A| = dt |grad v| about 0.03, and of rounding / e.
    const double e = 1e-3;
    const std::vector<double> ahead = moved_impulse(s, v, e);
    const std::vector<double> behind = moved_impulse(s, v, -e);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], (ahead[i] - behind[i]) / (2 * e), 1e-7 * largest(found));
  });
}

TEST_P(Stiffness, WithTheStressItIsTheExplicitForce) {
  for_variants(GetParam(), [](Sample& s) {
    normalize_strains(s);
    const std::vector<double> v = node_velocities(s, 3);
    const std::vector<double> found = impulse(s, {1, 0, 0, 0}, v);
    const std::vector<double> expected = moved_impulse(s, v, 0);
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-12 * largest(expected));
  });
}

TEST_P(Stiffness, IsSymmetricInItsPartsAndItsMaterialPartIsNeverNegative) {
  for_variants(GetParam(), [](Sample& s) {
    const std::vector<double> u = node_velocities(s, 4);
    const std::vector<double> v = node_velocities(s, 5);
    const std::vector<mpm::StiffnessTerms<double>> parts = {{0, 1, 0, 0}, kWhole, {0, 0, 0, 0.1}};
    for (const auto& terms : parts) {
      const std::vector<double> ku = impulse(s, terms, u);
      const std::vector<double> kv = impulse(s, terms, v);
      const double scale = std::sqrt(dot(u, u) * dot(kv, kv));
      EXPECT_NEAR(dot(ku, v), dot(u, kv), 1e-13 * scale);
      EXPECT_GT(std::abs(dot(ku, v)), 1e-6 * scale);
    }
    for (unsigned seed = 6; seed < 30; ++seed) {
      const std::vector<double> w = node_velocities(s, seed);
      EXPECT_LT(dot(w, impulse(s, parts[0], w)), 0);  // the impulse brakes
    }
  });
}

TEST_P(Stiffness, TakesNothingFromATranslation) {
  for_variants(GetParam(), [](Sample& s) {
    std::vector<double> v(static_cast<std::size_t>(mpm::buffer_reals(s.dimension)), 0);
    s.for_nodes([&](std::size_t q, const Vec3&) {
      for (int a = 0; a < s.dimension; ++a) v[q + 1 + static_cast<std::size_t>(a)] = 0.7 - a;
    });
    const std::vector<double> rough = node_velocities(s, 7);
    EXPECT_LT(largest(impulse(s, kWhole, v)), 1e-12 * largest(impulse(s, kWhole, rough)));
  });
}

TEST_P(Stiffness, LimitsTheStressOfWeakPointsAsTheExplicitForceDoes) {
  for (const int dimension : {2, 3}) {
    Sample s(dimension, true, false, GetParam(), true);
    s.material.tearing = {0.5};
    s.for_points([&](std::size_t t, int lane) {
      s.set.values<double>(t, Field::kPlasticity)[lane] = lane % 2;  // every other point is weak
    });
    const std::vector<double> still(static_cast<std::size_t>(mpm::buffer_reals(dimension)), 0);
    s.kernels.scatter(s.points(), s.place(), s.step(), s.momentum.data(), s.force.data());
    const std::vector<double> limited = impulse(s, {1, 0, 0, 0}, still);
    for (std::size_t i = 0; i < limited.size(); ++i)
      EXPECT_NEAR(limited[i], kStep * s.force[i], 1e-12 * largest(limited));
    s.material.tearing = {1e300};
    const std::vector<double> whole = impulse(s, {1, 0, 0, 0}, still);
    EXPECT_GT(std::abs(largest(whole) - largest(limited)), 1e-3 * largest(whole));
  }
}

TEST_P(Stiffness, AWeakPointResistsCompressionButNotOpening) {
  for (const int dimension : {2, 3}) {
    Sample s(dimension, true, false, GetParam(), true);
    s.material.tearing = {0.5};
    const std::vector<double> v = node_velocities(s, 8);
    const auto stiffness_at = [&](double volume_change) {
      s.for_points([&](std::size_t t, int lane) {
        s.set.values<double>(t, Field::kPlasticity)[lane] = 1;
        s.set.values<double>(t, Field::kVolumeChange)[lane] = volume_change;
      });
      return largest(impulse(s, {0, 1, 0, 0}, v));
    };
    EXPECT_EQ(stiffness_at(0.05), 0);
    EXPECT_GT(stiffness_at(-0.05), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Stiffness, testing::ValuesIn(levels_here()), level_name);

}  // namespace
}  // namespace lather
