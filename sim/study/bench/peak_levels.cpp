#include "sim/kernel_table.h"
#include "sim/study/bench/peak_kernels.h"

namespace lather::study {

// One object file each, made from peak_kernels.cpp.
const PeakKernels<float>& float_peak_kernels_v2();
const PeakKernels<float>& float_peak_kernels_v3();
const PeakKernels<float>& float_peak_kernels_v4();
const PeakKernels<double>& double_peak_kernels_v2();
const PeakKernels<double>& double_peak_kernels_v3();
const PeakKernels<double>& double_peak_kernels_v4();

template <>
const PeakKernels<float>& peak_kernels<float>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, float_peak_kernels)();
}

template <>
const PeakKernels<double>& peak_kernels<double>(KernelLevel level) {
  return LATHER_AT_LEVEL(level, double_peak_kernels)();
}

}  // namespace lather::study
