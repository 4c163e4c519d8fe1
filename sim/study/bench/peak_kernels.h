#pragma once

#include <cstdint>

#include "sim/kernel_level.h"

namespace lather::study {

/// Loops that do nothing but what is counted, once per kernel level.
template <class Real>
struct PeakKernels {
  /// Operations of one repeat of multiply_add.
  int operations = 0;
  /// Multiplies by `factor` and adds `term`, `repeats` times, in as many independent chains as keep the units
  /// busy. The result depends on all of them.
  Real (*multiply_add)(std::int64_t repeats, Real factor, Real term) = nullptr;
  /// Sum of `count` numbers, a multiple of 256.
  Real (*sum)(const Real* from, std::int64_t count) = nullptr;
};

/// The kernels of a level, which the machine must have.
template <class Real>
[[nodiscard]] const PeakKernels<Real>& peak_kernels(KernelLevel level);

}  // namespace lather::study
