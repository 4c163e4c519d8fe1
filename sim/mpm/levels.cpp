#include "sim/mpm/levels.h"

#include "sim/kernel_table.h"

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
  return LATHER_AT_LEVEL(level, float_kernels)();
}

template <>
const KernelTable<double>& kernel_table<double>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, double_kernels)();
}

}  // namespace lather::mpm
