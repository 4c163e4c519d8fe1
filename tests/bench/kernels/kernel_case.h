#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/kernel_level.h"
#include "sim/scene/scene.h"

/// Kernels to be measured: each on data that a short run of a bench scene left.
namespace lather::bench {

/// One kernel with its data. run() may be called again and again: it starts from the same state each time, or
/// from one that costs the same.
struct KernelWork {
  std::int64_t points = 0;  ///< that a call of run() works on
  std::function<void()> run;
};

struct KernelCase {
  std::string name;  ///< method/kernel/…/precision
  std::function<KernelWork(KernelLevel)> make;
};

/// Points to the grid and back, of one full block; each law on a tile of 16 points.
void add_mpm_cases(std::vector<KernelCase>& cases);
/// Shape functions, gradients and momentum of a tile inside a cloud.
void add_mlsrk_cases(std::vector<KernelCase>& cases);
/// Eigenvalues, singular values and rotations of 16 tensors.
void add_tensor_cases(std::vector<KernelCase>& cases);
/// Whole steps of the cases of `lather bench`.
void add_step_cases(std::vector<KernelCase>& cases);

/// The scene of a case of `lather bench`.
[[nodiscard]] Scene bench_scene(const std::string& name, std::uint64_t points);

template <class Real>
[[nodiscard]] const char* precision_name() {
  return sizeof(Real) == 4 ? "float" : "double";
}

}  // namespace lather::bench
