#pragma once

#include <string>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// How far the first two materials of a 2D scene have separated: the mean height of the second's points less
/// that of the first's, over the same where each lies in a layer of its own across the whole domain. About 0
/// for a mixture; waves take it beyond 1 for moments.
[[nodiscard]] double separation_index(const Scene& scene, const Simulation& simulation);

/// Means over half a second at the start, in the middle and at the end of a run.
struct Separation {
  double start = 0;
  double middle = 0;
  double end = 0;
};
[[nodiscard]] Separation run_separation(const std::string& size, const std::vector<Override>& overrides,
                                        int threads);

}  // namespace lather::testing_support
