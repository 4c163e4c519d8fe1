#include "sim/plan/plan.h"

namespace lather {

const char* to_string(KernelLevel level) {
  switch (level) {
    case KernelLevel::kV2:
      return "x86-64-v2";
    case KernelLevel::kV3:
      return "x86-64-v3";
    case KernelLevel::kV4:
      return "x86-64-v4";
  }
  return "";
}

KernelLevel kernel_level_from_string(std::string_view name) {
  for (const KernelLevel level : {KernelLevel::kV2, KernelLevel::kV3, KernelLevel::kV4})
    if (name == to_string(level)) return level;
  throw InputError({{"/choices/kernel_level", std::string(name), "x86-64-v2, x86-64-v3, x86-64-v4",
                     "This is no kernel level."}});
}

bool machine_has(KernelLevel level) {
  __builtin_cpu_init();
#ifdef LATHER_LEAST_KERNEL_LEVEL_ALONE
  if (level != KernelLevel::kV2) return false;
#endif
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                  __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  switch (level) {
    case KernelLevel::kV2:
      return true;
    case KernelLevel::kV3:
      return v3;
    case KernelLevel::kV4:
      return v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
  }
  return false;
}

KernelLevel best_kernel_level() {
  for (const KernelLevel level : {KernelLevel::kV4, KernelLevel::kV3})
    if (machine_has(level)) return level;
  return KernelLevel::kV2;
}

}  // namespace lather
