#include "sim/mpm/levels.h"

namespace lather::mpm {

// One object file each, made from kernels.cpp.
const KernelTable<float>& float_kernels_v2();
const KernelTable<float>& float_kernels_v3();
const KernelTable<float>& float_kernels_v4();
const KernelTable<double>& double_kernels_v2();
const KernelTable<double>& double_kernels_v3();
const KernelTable<double>& double_kernels_v4();

template <>
const KernelTable<float>& kernel_table<float>(KernelLevel level) {
  return at_level(level, float_kernels_v2, float_kernels_v3, float_kernels_v4)();
}

template <>
const KernelTable<double>& kernel_table<double>(KernelLevel level) {
  return at_level(level, double_kernels_v2, double_kernels_v3, double_kernels_v4)();
}

}  // namespace lather::mpm
