#pragma once

#include <string_view>

namespace lather {

/// Instruction sets that kernels are compiled for. Results are bit-equal within one level.
enum class KernelLevel { kV2, kV3, kV4 };

[[nodiscard]] const char* to_string(KernelLevel level);                ///< "x86-64-v2" …
[[nodiscard]] KernelLevel kernel_level_from_string(std::string_view);  ///< throws InputError
[[nodiscard]] KernelLevel best_kernel_level();                         ///< of the machine this runs on
[[nodiscard]] bool machine_has(KernelLevel level);

/// The one of three that belongs to a level.
template <class T>
[[nodiscard]] constexpr T at_level(KernelLevel level, T v2, T v3, T v4) {
  return level == KernelLevel::kV4 ? v4 : level == KernelLevel::kV3 ? v3 : v2;
}

}  // namespace lather
