// The transfers between points and grid against their definitions, summed naively point by point and node by
// node. [Foam E.3 steps 1, 3, 7, 9]

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sim/mpm/levels.h"
#include "sim/particles/particle_set.h"
#include "tests/support/kernel_levels.h"

namespace lather {
namespace {

using mpm::kBufferBelow;
using mpm::kBufferWidth;
using mpm::kQuad;

constexpr double kCell = 0.1;
constexpr double kStep = 1e-3;

double spline(bool cubic, double x) {
  x = std::abs(x);
  if (cubic) {
    if (x < 1) return 0.5 * x * x * x - x * x + 2.0 / 3;
    return x < 2 ? std::pow(2 - x, 3) / 6 : 0;
  }
  if (x < 0.5) return 0.75 - x * x;
  return x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}
double spline_slope(bool cubic, double x) {
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
  Sample(int dim, bool with_cubic, bool with_apic, KernelLevel level)
      : dimension(dim),
        cubic(with_cubic),
        apic(with_apic),
        table(mpm::kernel_table<double>(level)),
        kernels(table.step[dim - 2][with_cubic ? 1 : 0][with_apic ? 1 : 0]),
        set(dim, fields(with_apic), Vec3::Zero(), kCell) {
    material = {0.5, 0.002, {1000, 300, 1e300, 1, 1, 1, 2.2e-16}, {1e300}};
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

  static std::vector<Field> fields(bool apic) {
    std::vector<Field> f = {Field::kFraction,      Field::kVelocity, Field::kVolumeChange,
                            Field::kElasticStrain, Field::kId,       Field::kCell};
    if (apic) f.push_back(Field::kAffine);
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
    table.point.stress(material.law, state, s);
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

class Transfer : public testing::TestWithParam<KernelLevel> {};

TEST_P(Transfer, ScatterAddsMassMomentumAndForceByTheirDefinitions) {
  for_variants(GetParam(), [](Sample& s) {
    s.kernels.scatter(s.points(), s.place(), s.step(), s.momentum.data(), s.force.data());
    s.for_nodes([&](std::size_t q, const Vec3& node) {
      double mass = 0;
      Vec3 p = Vec3::Zero();
      Vec3 f = Vec3::Zero();
      s.for_points([&](std::size_t t, int lane) {
        const Vec3 from = node - s.set.position(t, lane);
        mass += s.weight(from) * s.material.mass;
        p += s.weight(from) * s.material.mass * (s.set.velocity(t, lane) + s.affine(t, lane) * from);
        f -= s.material.volume * s.stress(t, lane) * s.weight_gradient(from);
      });
      if (s.apic) p += kStep * f;
      EXPECT_NEAR(s.momentum[q], mass, 1e-13);
      for (int a = 0; a < s.dimension; ++a) {
        EXPECT_NEAR(s.momentum[q + 1 + static_cast<std::size_t>(a)], p[a], 1e-12);
        if (!s.apic) {
          EXPECT_NEAR(s.force[q + 1 + static_cast<std::size_t>(a)], f[a], 1e-10);
        }
      }
    });
  });
}

TEST_P(Transfer, GatherReadsVelocitiesAndDeformationByTheirDefinitions) {
  for_variants(GetParam(), [](Sample& s) {
    // Some smooth velocity field on the nodes, and an increment.
    const auto v_at = [&](const Vec3& x) {
      return Vec3(std::sin(9 * x.x()), x.y() * x.x(), s.dimension == 3 ? std::cos(7 * x.z()) : 0);
    };
    const auto dv_at = [&](const Vec3& x) {
      return Vec3(0.1 * x.y(), 0.2, s.dimension == 3 ? 0.3 * x.x() : 0);
    };
    s.for_nodes([&](std::size_t q, const Vec3& node) {
      for (int a = 0; a < s.dimension; ++a) {
        s.momentum[q + 1 + static_cast<std::size_t>(a)] = v_at(node)[a];
        s.force[q + 1 + static_cast<std::size_t>(a)] = dv_at(node)[a];
      }
    });
    const Sample before = s;
    s.kernels.gather(s.points(), s.place(), s.step(), s.momentum.data(), s.apic ? nullptr : s.force.data());
    s.for_points([&](std::size_t t, int lane) {
      const Vec3 x = s.set.position(t, lane);
      Vec3 pic = Vec3::Zero();
      Vec3 change = Vec3::Zero();
      Mat3 gradient = Mat3::Zero();
      Mat3 moment = Mat3::Zero();
      s.for_nodes([&](std::size_t, const Vec3& node) {
        const double w = s.weight(node - x);
        pic += w * v_at(node);
        change += w * dv_at(node);
        gradient += v_at(node) * s.weight_gradient(node - x).transpose();
        moment += w * v_at(node) * (node - x).transpose();
      });
      const Vec3 expected = s.apic ? pic : Vec3(0.1 * pic + 0.9 * (before.set.velocity(t, lane) + change));
      const double D = (s.cubic ? 1.0 / 3 : 0.25) * kCell * kCell;
      for (int a = 0; a < s.dimension; ++a) {
        EXPECT_NEAR(s.set.velocity(t, lane)[a], expected[a], 1e-12);
        if (s.apic) {
          for (int b = 0; b < s.dimension; ++b) EXPECT_NEAR(s.affine(t, lane)(a, b), moment(a, b) / D, 1e-9);
        }
      }
      const double J = (1 + before.set.values<double>(t, Field::kVolumeChange)[lane]) *
                       (Mat3::Identity() + kStep * gradient).determinant();
      EXPECT_NEAR(1 + s.set.values<double>(t, Field::kVolumeChange)[lane], J, 1e-12);
    });
  });
}

TEST_P(Transfer, ReduceAndCollectAreInverseWays) {
  // A buffer reduced onto the 3^dim grid blocks around it and collected again is the same buffer.
  for (const int dimension : {2, 3}) {
    const auto& kernels = mpm::kernel_table<double>(GetParam()).step[dimension - 2][1][0];
    std::vector<double> buffer(static_cast<std::size_t>(mpm::buffer_reals(dimension)), 0);
    const auto used = static_cast<std::size_t>(kQuad * mpm::power(kBufferWidth, dimension));
    for (std::size_t i = 0; i < used; ++i) buffer[i] = static_cast<double>(i + 1);
    const int count = mpm::neighbours(dimension);
    std::vector<std::vector<double>> blocks;
    for (int n = 0; n < count; ++n) {
      // Block n lies at offset o from the points' block, which lies at -o from it: neighbour count - 1 - n.
      std::vector<const double*> from(27, nullptr);
      from[static_cast<std::size_t>(count - 1 - n)] = buffer.data();
      blocks.emplace_back(static_cast<std::size_t>(mpm::block_reals(dimension)));
      kernels.reduce(from.data(), blocks.back().data());
    }
    std::vector<const double*> around;
    for (const auto& block : blocks) around.push_back(block.data());
    std::vector<double> collected(buffer.size(), -1);
    kernels.collect(around.data(), collected.data());
    EXPECT_EQ(collected, buffer);
  }
}

INSTANTIATE_TEST_SUITE_P(Levels, Transfer, testing::ValuesIn(testing_support::levels_here()),
                         testing_support::level_name);

}  // namespace
}  // namespace lather
