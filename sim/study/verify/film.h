#pragma once

#include "sim/simulation.h"
#include "sim/study/verify/case.h"

namespace lather::study {

/// Herschel-Bulkley film on a slope, at three spacings, and one that must not flow.
[[nodiscard]] std::vector<Finding> verify_film(int threads);
/// The same velocity profile at finer spacings.
[[nodiscard]] std::vector<Finding> verify_fine_film(int threads);

/// The film that flows, `cells` over its thickness, in one frame up to when its start has died out.
[[nodiscard]] Scene flowing_film(int cells, int points_per_cell = 4);
/// Root of the mean square of the velocity's error over the points, over the plug's speed.
[[nodiscard]] double film_error(const Simulation& simulation);

}  // namespace lather::study
