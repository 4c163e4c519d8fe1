#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "sim/plan/plan.h"

namespace lather {

/// For GoogleTest, which would print the level's bytes.
inline void PrintTo(KernelLevel level, std::ostream* out) {
  *out << to_string(level);
}

}  // namespace lather

namespace lather::testing_support {

/// The kernel levels that this machine can run.
inline std::vector<KernelLevel> levels_here() {
  std::vector<KernelLevel> levels;
  for (const KernelLevel level : {KernelLevel::kV2, KernelLevel::kV3, KernelLevel::kV4})
    if (machine_has(level)) levels.push_back(level);
  return levels;
}

/// Names of parameterised tests: V2, V3, V4.
inline std::string level_name(const testing::TestParamInfo<KernelLevel>& info) {
  const std::string name = to_string(info.param);
  return "V" + name.substr(name.size() - 1);
}

}  // namespace lather::testing_support
