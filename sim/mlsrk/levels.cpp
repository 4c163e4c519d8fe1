#include "sim/mlsrk/levels.h"

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
  switch (level) {
    case KernelLevel::kV4:
      return float_mlsrk_kernels_v4();
    case KernelLevel::kV3:
      return float_mlsrk_kernels_v3();
    case KernelLevel::kV2:
      break;
  }
  return float_mlsrk_kernels_v2();
}

template <>
const KernelTable<double>& kernel_table<double>(KernelLevel level) {
  switch (level) {
    case KernelLevel::kV4:
      return double_mlsrk_kernels_v4();
    case KernelLevel::kV3:
      return double_mlsrk_kernels_v3();
    case KernelLevel::kV2:
      break;
  }
  return double_mlsrk_kernels_v2();
}

}  // namespace lather::mlsrk
