#include "sim/kernel_table.h"
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
  return LATHER_AT_LEVEL(level, float_law_kernels)();
}

template <>
const LawPointTable<double>& law_point_kernels<double>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, double_law_kernels)();
}

}  // namespace lather
