#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/simulation.h"

namespace lather::testing_support {

/// How far the first two materials of a scene have separated: the mean height of the second's points less
/// that of the first's, over the same where each lies in a layer of its own on the whole floor. About 0 for a
/// mixture; waves take it beyond 1 for moments.
[[nodiscard]] double separation_index(const Scene& scene, const Simulation& simulation);

/// Means over half a second at the start, in the middle and at the end of a run; its cost.
struct Separation {
  double start = 0;
  double middle = 0;
  double end = 0;
  double seconds = 0;        ///< of computing
  std::uint64_t points = 0;  ///< at the start
};
[[nodiscard]] Separation run_separation(const std::string& size, const std::vector<Override>& overrides,
                                        int threads);

/// The same scene by three ways, to `duration` (s): by particles; on a grid with as many points, four to a
/// cell; and on a grid with as many nodes, its degrees of freedom, as there are particles, with four times
/// the points [MLSRK section 3.3]. `finer_step` is that of the last, s.
struct ComparedSeparation {
  Separation particles;
  Separation equal_points;
  Separation equal_nodes;
};
[[nodiscard]] ComparedSeparation compare_separations(const std::string& size, double duration,
                                                     double finer_step, int threads);

}  // namespace lather::testing_support
