// The return mappings of snow and of Drucker and Prager at many random states, up to stretches of 1e-3 and
// 1e3, in both precisions.

#include "tests/unit/sim/material/plastic_laws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/kernel_levels.h"

#ifndef LATHER_STATES_TIMES
#define LATHER_STATES_TIMES 1
#endif

namespace lather {
namespace {

/// How many times the states of the quick test a long run takes.
constexpr int kTimes = LATHER_STATES_TIMES;

using testing_support::condition;
using testing_support::LogMap;
using testing_support::Logs;
using testing_support::MappedLogs;
using testing_support::PlasticStates;
using testing_support::random_states;
using testing_support::Tensor;
using testing_support::yield;
using Svd = Eigen::JacobiSVD<Tensor>;

/// The largest ratio of an error to its bound, and where it was.
struct Worst {
  double ratio = 0;
  int point = -1;

  void see(double error, double bound, int at) {
    const double r = error / bound;
    if (r <= ratio || std::isnan(ratio)) return;  // a NaN is worse than any
    ratio = r;
    point = at;
  }
};

Logs logs_of(const Tensor& F) {
  return Svd(F).singularValues().array().log();
}

double largest(const Tensor& m) {
  return m.cwiseAbs().maxCoeff();
}

template <class Real>
constexpr double kEpsilon = static_cast<double>(std::numeric_limits<Real>::epsilon());

/// How many roundings of the worst kind a bound allows.
constexpr double kRoundings = 24;

/// Every state after yield against the referee's. Small strains are held to the rounding of strains, not of
/// 1: `law_strain` is the largest strain among the law's constants.
template <class Real, class Law>
void expect_referee(const LawPointKernels<Real>& kernels, const Law& law, const LogMap& map,
                    double law_strain, const PlasticStates<Real>& before) {
  PlasticStates<Real> after = before;
  yield(kernels, law, after);
  Worst tensor;
  Worst volume;
  const Tensor one = Tensor::Identity(before.dimension, before.dimension);
  for (int n = 0; n < before.size(); ++n) {
    const Svd svd(before.deformation(n), Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Logs log = svd.singularValues().array().log();
    const MappedLogs expected = map(log, before.plastic_ratio(n));
    const Tensor stretch = Tensor(expected.log.exp().matrix().asDiagonal());
    const Tensor F = svd.matrixU() * stretch * svd.matrixV().transpose();
    const double strain =
        std::max({largest(before.difference(n)), largest(F - one), std::abs(before.plastic_ratio(n) - 1),
                  std::abs(expected.J_p - 1), law_strain});
    // The referee's F is rounded in double.
    const double part = strain < 0.1 ? 10 * strain + 10 * kEpsilon<double> / kEpsilon<Real>
                                     : condition(log) * (1 + std::exp(expected.log.maxCoeff()));
    tensor.see(largest(after.deformation(n) - F), kEpsilon<Real> * part, n);
    // J_p - 1 is what is stored and added to; a logarithm is rounded by its own size.
    const double logs = log.abs().sum() + std::abs(std::log(before.plastic_ratio(n)));
    const double volume_part =
        strain < 0.1 ? part : 1 + before.plastic_ratio(n) + (condition(log) + logs) * expected.J_p;
    volume.see(std::abs(after.plastic_ratio(n) - expected.J_p), kEpsilon<Real> * volume_part, n);
  }
  EXPECT_LE(tensor.ratio, kRoundings) << "point " << tensor.point;
  EXPECT_LE(volume.ratio, kRoundings) << "point " << volume.point;
}

/// What is within the yield surface stays: a second correction changes roundings only.
template <class Real, class Law>
void expect_idempotent(const LawPointKernels<Real>& kernels, const Law& law, PlasticStates<Real> once) {
  yield(kernels, law, once);
  PlasticStates<Real> twice = once;
  yield(kernels, law, twice);
  Worst worst;
  for (int n = 0; n < once.size(); ++n) {
    const Tensor F = once.deformation(n);
    const double change =
        std::max(largest(twice.deformation(n) - F) / (1 + largest(F)),
                 std::abs(twice.plastic_ratio(n) - once.plastic_ratio(n)) / (1 + once.plastic_ratio(n)));
    worst.see(change, kEpsilon<Real> * condition(logs_of(F)), n);
  }
  EXPECT_LE(worst.ratio, kRoundings) << "point " << worst.point;
}

/// Turned states yield to turned states: Q F -> Q F~ and F Q -> F~ Q.
template <class Real, class Law>
void expect_indifferent(const LawPointKernels<Real>& kernels, const Law& law,
                        const PlasticStates<Real>& before) {
  std::mt19937 rng(5);
  PlasticStates<Real> plain = before;
  PlasticStates<Real> left;
  PlasticStates<Real> right;
  left.dimension = right.dimension = before.dimension;
  std::vector<Tensor> Q;
  for (int n = 0; n < before.size(); ++n) {
    Q.push_back(testing_support::random_rotation(rng, before.dimension));
    left.push_back(Q.back() * before.deformation(n), before.plastic_ratio(n));
    right.push_back(before.deformation(n) * Q.back(), before.plastic_ratio(n));
  }
  yield(kernels, law, plain);
  yield(kernels, law, left);
  yield(kernels, law, right);
  Worst worst;
  for (int n = 0; n < before.size(); ++n) {
    const Tensor F = plain.deformation(n);
    const Tensor& q = Q[static_cast<std::size_t>(n)];
    const double error =
        std::max(largest(left.deformation(n) - q * F), largest(right.deformation(n) - F * q));
    worst.see(error, kEpsilon<Real> * condition(logs_of(before.deformation(n))) * (1 + largest(F)), n);
  }
  EXPECT_LE(worst.ratio, kRoundings) << "point " << worst.point;
}

class PlasticLaws : public testing::TestWithParam<KernelLevel> {
 protected:
  /// Calls check(kernels, states) in both precisions and dimensions.
  template <class Check>
  void for_states(int count, const Check& check) const {
    for (const int dimension : {2, 3}) {
      SCOPED_TRACE("dimension " + std::to_string(dimension));
      check(law_point_kernels<double>(GetParam()).wide, random_states<double>(dimension, count, 1));
      check(law_point_kernels<float>(GetParam()).wide, random_states<float>(dimension, count, 2));
    }
  }
};

TEST_P(PlasticLaws, SnowDoesWhatTheRefereeDoesAtAnyStretch) {
  const SnowParameters p = testing_support::snow();
  for_states(40'000 * kTimes, [&](const auto& kernels, const auto& states) {
    expect_referee(kernels, p, testing_support::referee(p), p.critical_compression, states);
  });
}

TEST_P(PlasticLaws, DruckerPragerDoesWhatTheRefereeDoesAtAnyStretch) {
  for (const DruckerPragerParameters& p : testing_support::grains())
    for_states(20'000 * kTimes, [&](const auto& kernels, const auto& states) {
      expect_referee(kernels, p, testing_support::referee(p, states.dimension), p.cohesion, states);
    });
}

TEST_P(PlasticLaws, ASecondCorrectionChangesNothing) {
  for_states(20'000 * kTimes, [&](const auto& kernels, const auto& states) {
    expect_idempotent(kernels, testing_support::snow(), states);
    for (const DruckerPragerParameters& p : testing_support::grains()) expect_idempotent(kernels, p, states);
  });
}

TEST_P(PlasticLaws, TurningTheBodyOrItsRestStateTurnsTheResult) {
  for_states(5'000 * kTimes, [&](const auto& kernels, const auto& states) {
    expect_indifferent(kernels, testing_support::snow(), states);
    for (const DruckerPragerParameters& p : testing_support::grains()) expect_indifferent(kernels, p, states);
  });
}

TEST_P(PlasticLaws, SnowKeepsItsStretchesWithinTheClamps) {
  const SnowParameters p = testing_support::snow();
  for_states(10'000 * kTimes, [&](const auto& kernels, auto states) {
    using Real = typename std::remove_reference_t<decltype(states.G)>::value_type;
    yield(kernels, p, states);
    // Each entry of F is rounded by epsilon/2, wherever it came from.
    const double slack = kRoundings * kEpsilon<Real>;
    for (int n = 0; n < states.size(); ++n) {
      const Svd svd(states.deformation(n));
      ASSERT_GE(svd.singularValues().minCoeff(), 1 - p.critical_compression - slack) << n;
      ASSERT_LE(svd.singularValues().maxCoeff(), 1 + p.critical_stretch + slack) << n;
    }
  });
}

TEST_P(PlasticLaws, DruckerPragerStaysWithinItsCone) {
  for (const DruckerPragerParameters& p : testing_support::grains())
    for_states(10'000 * kTimes, [&](const auto& kernels, auto states) {
      using Real = typename std::remove_reference_t<decltype(states.G)>::value_type;
      const auto slope = static_cast<double>(drucker_prager_constants<Real>(p, states.dimension).slope);
      yield(kernels, p, states);
      Worst worst;
      for (int n = 0; n < states.size(); ++n) {
        const Logs log = logs_of(states.deformation(n));
        const Logs eps = log - p.cohesion;
        const double trace = eps.sum();
        const double deviator = (eps - trace / states.dimension).matrix().norm();
        const double bound = kEpsilon<Real> * condition(log) * (1 + slope);
        worst.see(std::max(trace, deviator + slope * trace), bound, n);
      }
      EXPECT_LE(worst.ratio, kRoundings) << "point " << worst.point;
    });
}

TEST_P(PlasticLaws, StatesBeyondAnyUseStayFinite) {
  // So far apart that F's rounding hides the smaller stretches, or lets F turn inside out.
  std::mt19937 rng(4);
  PlasticStates<float> states;
  for (int n = 0; n < 64; ++n) {
    const Eigen::Vector3d stretch(n % 2 == 0 ? 1e9 : 1, n % 4 < 2 ? 1e-9 : n % 3, 1e-9);
    const Tensor Q = testing_support::random_rotation(rng, 3);
    const Tensor F = n < 32 ? Tensor(stretch.asDiagonal()) : Tensor(Q * stretch.asDiagonal());
    states.push_back(F * testing_support::random_rotation(rng, 3), 1);
  }
  const auto expect_finite = [&](const auto& law) {
    PlasticStates<float> after = states;
    yield(law_point_kernels<float>(GetParam()).wide, law, after);
    for (int n = 0; n < after.size(); ++n) {
      EXPECT_TRUE(after.deformation(n).allFinite()) << n;
      EXPECT_TRUE(std::isfinite(after.plastic_ratio(n))) << n;
    }
  };
  expect_finite(testing_support::snow());
  for (const DruckerPragerParameters& p : testing_support::grains()) expect_finite(p);
}

TEST_P(PlasticLaws, EveryLaneDoesWhatTheScalarTwinDoes) {
  const auto& in_float = law_point_kernels<float>(GetParam());
  for (const int dimension : {2, 3}) {
    PlasticStates<float> scalar = random_states<float>(dimension, 4'003, 3);  // neighbours of all kinds
    PlasticStates<float> wide = scalar;
    const PlasticStates<float> before = scalar;
    const DruckerPragerParameters p = testing_support::grains()[1];
    yield(in_float.scalar, p, scalar);
    yield(in_float.wide, p, wide);
    Worst worst;
    for (int n = 0; n < before.size(); ++n) {
      const Tensor F = scalar.deformation(n);
      worst.see(largest(wide.deformation(n) - F),
                kEpsilon<float> * condition(logs_of(before.deformation(n))) * (1 + largest(F)), n);
    }
    EXPECT_LE(worst.ratio, kRoundings) << "point " << worst.point;
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, PlasticLaws, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
