#pragma once

#include "sim/scene/scene.h"
#include "sim/study/verify/case.h"

namespace lather::study {

/// Frequency and decay of an elastic standing wave.
[[nodiscard]] std::vector<Finding> verify_standing_wave(int threads);

inline constexpr int kStandingWavePeriods = 4;  ///< from its first frame to its last
/// The wave in a bar `cells` long, which starts with all its energy in the velocity; so many frames a period.
[[nodiscard]] Scene standing_wave(int cells, int frames_per_period, int points_per_cell = 4);

}  // namespace lather::study
