#include "sim/mlsrk/levels.h"

#include "sim/kernel_table.h"

namespace lather::mlsrk {

// One object file each, made from kernels.cpp.
const KernelTable<float>& float_mlsrk_kernels_v2();
const KernelTable<float>& float_mlsrk_kernels_v3();
const KernelTable<float>& float_mlsrk_kernels_v4();
const KernelTable<double>& double_mlsrk_kernels_v2();
const KernelTable<double>& double_mlsrk_kernels_v3();
const KernelTable<double>& double_mlsrk_kernels_v4();

template <>
const KernelTable<float>& kernel_table<float>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, float_mlsrk_kernels)();
}

template <>
const KernelTable<double>& kernel_table<double>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, double_mlsrk_kernels)();
}

}  // namespace lather::mlsrk
