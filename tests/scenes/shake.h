#pragma once

#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/simulation.h"

/// The shaken shaving cream under three laws that are alike at one rate of flow.
namespace lather::testing_support {

/// The rate of plastic flow, 1/s, at which all three bear the same stress. Where the foam flows faster than
/// this, as it does in a neck, the perfectly plastic one is the softest and the viscoplastic one the
/// stiffest.
inline constexpr double kMatchedFlow = 0.2;

/// Share of the points that a torn-off piece holds at least, and how long (s) it stays away.
inline constexpr double kTornPiece = 0.1;
inline constexpr double kTornFor = 0.05;

/// What changes the scene's Herschel-Bulkley foam into a perfectly plastic one: the stress norm at the
/// matched flow, sqrt(2/3) sigma_Y + eta kMatchedFlow^h, becomes the yield stress norm, and eta vanishes.
[[nodiscard]] std::vector<Override> perfectly_plastic(const Scene& scene);

/// … and into a Bingham fluid: the same yield stress, h = 1.
[[nodiscard]] std::vector<Override> viscoplastic(const Scene& scene);

struct Shake {
  Report report;
  double tear_time = 0;  ///< s; infinite where it does not tear in the run's time
};

/// Runs the scene for `duration` (s) at 60 frames a second.
[[nodiscard]] Shake shake(const std::string& size, double duration, std::vector<Override> overrides,
                          int threads);

/// The worst of all frames, and what it was measured on.
struct Held {
  double density_off = 0;             ///< largest |mean interior density - 1|
  double least_within_5_percent = 1;  ///< of the interior nodes
  std::uint64_t fewest_interior_nodes = 0;
  double skin_off = 0;  ///< largest |skin volume over that of frame 0 - 1|
};
[[nodiscard]] Held held(const Report& report);

}  // namespace lather::testing_support
