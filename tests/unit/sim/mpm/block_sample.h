#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim/mpm/levels.h"
#include "sim/particles/particle_set.h"

/// One block of points for tests of kernels against their definitions, summed point by point and node by
/// node.
namespace lather::testing_support {

using mpm::kBufferBelow;
using mpm::kBufferWidth;
using mpm::kQuad;

inline constexpr double kCell = 0.1;
inline constexpr double kStep = 1e-3;

inline double spline(bool cubic, double x) {
  x = std::abs(x);
  if (cubic) {
    if (x < 1) return 0.5 * x * x * x - x * x + 2.0 / 3;
    return x < 2 ? std::pow(2 - x, 3) / 6 : 0;
  }
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}
inline double spline_slope(bool cubic, double x) {
  const double a = std::abs(x);
  const double sign = x < 0 ? -1 : 1;
  if (cubic) {
    if (a < 1) return sign * (1.5 * a * a - 2 * a);
    return a < 2 ? -sign * 0.5 * (2 - a) * (2 - a) : 0;
  }
  if (a < 0.5) return -2 * x;
  return a < 1.5 ? -sign * (1.5 - a) : 0;
}

/// Forty points of elastic foam in the block that begins at node (4, 4, 4), with random velocity, C and
/// strain.
struct Sample {
  Sample(int dim, bool with_cubic, bool with_apic, KernelLevel level, bool tears = false)
      : dimension(dim),
        cubic(with_cubic),
        apic(with_apic),
        table(mpm::kernel_table<double>(level)),
        kernels(table.step[dim - 2][with_cubic ? 1 : 0][with_apic ? 1 : 0]),
        set(dim, fields(with_apic, tears), Vec3::Zero(), kCell) {
    material.mass = 0.5;
    material.volume = 0.002;
    material.law.herschel_bulkley = {1000, 300, 1e300, 1, 1, 1, 2.2e-16};
    material.tearing = {1e300};
    material.kernels = table.laws[dim - 2][0];
    std::mt19937 rng(static_cast<unsigned>(11 + dim));
    std::uniform_real_distribution<double> place(3.5, 7.5);
    std::uniform_real_distribution<double> value(-1, 1);
    for (std::uint32_t i = 0; i < 40; ++i) {
      Vec3 x = Vec3::Zero();
      Vec3 v = Vec3::Zero();
      Mat3 gradient = Mat3::Zero();
      for (int a = 0; a < dim; ++a) {
        x[a] = kCell * place(rng);
        v[a] = value(rng);
        for (int b = 0; b < dim; ++b) gradient(a, b) = 5 * value(rng);
      }
      set.add(x, v, gradient, i);
    }
    set.sort({dim, {12, 12, 12}, {}, false}, 1);
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane) {
        set.values<double>(t, Field::kVolumeChange)[lane] = 0.1 * value(rng);
        for (int c = 0; c < (dim == 3 ? 6 : 4); ++c)
          set.values<double>(t, Field::kElasticStrain, c)[lane] = 0.1 * value(rng);
      }
    const auto reals = static_cast<std::size_t>(mpm::buffer_reals(dim));
    momentum.assign(reals, 0);
    force.assign(reals, 0);
  }

  static std::vector<Field> fields(bool apic, bool tears) {
    std::vector<Field> f = {Field::kFraction,      Field::kVelocity, Field::kVolumeChange,
                            Field::kElasticStrain, Field::kId,       Field::kCell};
    if (apic) f.push_back(Field::kAffine);
    if (tears) f.push_back(Field::kPlasticity);
    return f;
  }

  [[nodiscard]] mpm::BlockPoints<double> points() {
    return {set.tile(0), static_cast<std::int32_t>(set.size()), &set.layout(), &material};
  }
  [[nodiscard]] mpm::BlockPlace place() const { return {{4, 4, dimension == 3 ? 4 : 0}}; }
  [[nodiscard]] mpm::StepConstants<double> step() const { return {kStep, kCell, {0, -9.81, 0}, 0.9, 0.25}; }

  /// Calls visit(index of the node's quad in a buffer, its position) for all nodes of the buffer.
  template <class Visit>
  void for_nodes(const Visit& visit) const {
    for (int n = 0; n < mpm::power(kBufferWidth, dimension); ++n) {
      Vec3 x = Vec3::Zero();
      int rest = n;
      for (int a = dimension - 1; a >= 0; --a) {
        x[a] = kCell * (4 - kBufferBelow + rest % kBufferWidth);
        rest /= kBufferWidth;
      }
      visit(static_cast<std::size_t>(n * kQuad), x);
    }
  }
  template <class Visit>
  void for_points(const Visit& visit) const {
    for (std::size_t i = 0; i < set.size(); ++i) visit(i / kTile, static_cast<int>(i % kTile));
  }

  [[nodiscard]] double weight(const Vec3& from) const {
    double w = 1;
    for (int a = 0; a < dimension; ++a) w *= spline(cubic, from[a] / kCell);
    return w;
  }
  [[nodiscard]] Vec3 weight_gradient(const Vec3& from) const {
    Vec3 g = Vec3::Zero();
    for (int a = 0; a < dimension; ++a) {
      g[a] =
          -spline_slope(cubic, from[a] / kCell) / kCell;  // by the point's place; `from` is node minus point
      for (int b = 0; b < dimension; ++b)
        if (b != a) g[a] *= spline(cubic, from[b] / kCell);
    }
    return g;
  }
  [[nodiscard]] Mat3 stress(std::size_t t, int lane) const {
    double state[7] = {set.values<double>(t, Field::kVolumeChange)[lane]};
    for (int c = 0; c < (dimension == 3 ? 6 : 4); ++c)
      state[1 + c] = set.values<double>(t, Field::kElasticStrain, c)[lane];
    double s[6];
    table.point.stress(material.law.herschel_bulkley, state, s);
    Mat3 tau;
    tau << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return tau;
  }
  [[nodiscard]] Mat3 affine(std::size_t t, int lane) const {
    Mat3 c = Mat3::Zero();
    if (apic)
      for (int a = 0; a < dimension; ++a)
        for (int b = 0; b < dimension; ++b)
          c(a, b) = set.values<double>(t, Field::kAffine, a * dimension + b)[lane];
    return c;
  }

  int dimension;
  bool cubic;
  bool apic;
  const mpm::KernelTable<double>& table;
  const mpm::Kernels<double>& kernels;
  ParticleSet<double> set;
  mpm::MaterialConstants<double> material{};
  std::vector<double> momentum;
  std::vector<double> force;
};

template <class Body>
void for_variants(KernelLevel level, const Body& body) {
  for (const int dimension : {2, 3})
    for (const bool cubic : {false, true})
      for (const bool apic : {false, true}) {
        SCOPED_TRACE(testing::Message() << dimension << "D, cubic " << cubic << ", APIC " << apic);
        Sample sample(dimension, cubic, apic, level);
        ASSERT_EQ(sample.set.ranges().size(), 1U);
        body(sample);
      }
}

}  // namespace lather::testing_support
