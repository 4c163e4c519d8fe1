#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::testing_support {

/// How a pulled dollop came apart.
struct Pull {
  std::optional<double> separated;  ///< s, of the first frame from which on it lay in two parts; none: never
  Report report;
};

/// Pulls the dollop until it has lain in two parts for `lasting` s (then stops), to `until` (s), or to the
/// end. Two parts: the second largest cluster (balls of half a spacing, see clusters.h) holds at least 2 % of
/// the points, some hundred, so that no crumb counts.
[[nodiscard]] Pull pull_dollop(const Scene& scene, int threads, double lasting, double until);

/// At a size that the scene's file names: brittle foam (eta_p = 100 s) comes apart earlier than the sticky
/// one of the scene, in the mean over `variants` of the scene, each made by its overrides; and the first
/// variant's sticky foam while the foam that does not tear is still one connected set.
void expect_tearing_parts_what_else_stays_connected(const std::string& size, int threads,
                                                    const std::vector<std::vector<Override>>& variants);

/// With subgrid removal, more than nothing and less than 0.28 % of the mass goes. [Foam Figure 8]
void expect_removal_takes_little(const std::string& size, int threads, std::vector<Override> overrides = {});

}  // namespace lather::testing_support
