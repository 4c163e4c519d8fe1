#include "sim/material/law_points.h"

namespace lather {

// One object file each, made from law_points.cpp.
const LawPointTable<float>& float_law_kernels_v2();
const LawPointTable<float>& float_law_kernels_v3();
const LawPointTable<float>& float_law_kernels_v4();
const LawPointTable<double>& double_law_kernels_v2();
const LawPointTable<double>& double_law_kernels_v3();
const LawPointTable<double>& double_law_kernels_v4();

template <>
const LawPointTable<float>& law_point_kernels<float>(KernelLevel level) {
  switch (level) {
    case KernelLevel::kV4:
      return float_law_kernels_v4();
    case KernelLevel::kV3:
      return float_law_kernels_v3();
    case KernelLevel::kV2:
      break;
  }
  return float_law_kernels_v2();
}

template <>
const LawPointTable<double>& law_point_kernels<double>(KernelLevel level) {
  switch (level) {
    case KernelLevel::kV4:
      return double_law_kernels_v4();
    case KernelLevel::kV3:
      return double_law_kernels_v3();
    case KernelLevel::kV2:
      break;
  }
  return double_law_kernels_v2();
}

}  // namespace lather
