// The transfers between points and grid against their definitions, summed naively point by point and node by
// node. [Foam E.3 steps 1, 3, 7, 9]

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/kernel_levels.h"
#include "tests/unit/sim/mpm/block_sample.h"

namespace lather {
namespace {

using namespace testing_support;

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
