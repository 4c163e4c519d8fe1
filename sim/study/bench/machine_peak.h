#pragma once

#include "sim/kernel_level.h"

namespace lather::study {

/// What one core can do, measured: the best of several short runs.
struct MachinePeak {
  double fma_gflops = 0;         ///< multiply-adds of floats, two operations each, 1e9/s
  double fma_gflops_double = 0;  ///< of doubles
  double l2_gbs = 0;             ///< reading 512 KiB again and again, 1e9 bytes/s
  double dram_gbs = 0;           ///< reading 256 MiB
};

/// At the instruction set of `level`, which the machine must have. Takes about two seconds and 256 MiB.
[[nodiscard]] MachinePeak measure_peak(KernelLevel level);

}  // namespace lather::study
