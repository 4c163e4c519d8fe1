#include <memory>
#include <random>

#include "sim/material/law_points.h"
#include "sim/mpm/levels.h"
#include "tests/bench/kernels/kernel_case.h"

namespace lather::bench {
namespace {

constexpr int kTensors = kTile;

/// Deformations I + G with strains of a few per cent, and room for what becomes of them.
template <class Real>
struct Tensors {
  Tensors() {
    std::mt19937 random(7);
    std::uniform_real_distribution<Real> entry(Real(-0.05), Real(0.05));
    for (Real& g : G) g = entry(random);
  }
  Real G[9 * kTensors];
  Real value[3 * kTensors];
  Real vector[9 * kTensors];
};

/// The single-point border puts one tensor in a lane beside 15 of rest and computes all 16.
template <class Real>
void add_tensors(std::vector<KernelCase>& cases) {
  const auto add = [&](const std::string& name, const auto& work) {
    cases.push_back({"tensor/" + name + "/" + precision_name<Real>(), [work](KernelLevel level) {
                       const auto t = std::make_shared<Tensors<Real>>();
                       return KernelWork{kTensors, [work, t, level] { work(*t, level); }};
                     }});
  };
  add("singular-values", [](Tensors<Real>& t, KernelLevel level) {
    law_point_kernels<Real>(level).wide.stretches(t.G, kTensors, t.value, t.vector);
  });
  add("eigenpairs", [](Tensors<Real>& t, KernelLevel level) {
    mpm::kernel_table<Real>(level).point.tearing_wide.eigenpairs(t.G, t.value, t.vector);
  });
  add("largest-eigenvalue", [](Tensors<Real>& t, KernelLevel level) {
    t.value[0] = mpm::kernel_table<Real>(level).point.tearing_wide.largest_eigenvalue(t.G);
  });
  add("rotation", [](Tensors<Real>& t, KernelLevel level) {
    mpm::kernel_table<Real>(level).point.tearing_wide.polar_rotation(t.G, t.vector);
  });
}

}  // namespace

void add_tensor_cases(std::vector<KernelCase>& cases) {
  add_tensors<float>(cases);
  add_tensors<double>(cases);
}

}  // namespace lather::bench
