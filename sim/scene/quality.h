#pragma once

#include <array>

#include "sim/scene/scene.h"
#include "sim/scene/value.h"

namespace lather {

/// A quality of a solver: settings picked by a rule from what `lather tradeoff --qualities` measured
/// (sim/study/tradeoff/front.h). The figures are those of docs/tradeoff.json; a test holds them together.
struct QualityPoint {
  Quality quality = Quality::kOwn;
  const char* name = "";
  const char* numerics = "";  ///< what it sets of a scene's "numerics", JSON
  double error = 0;           ///< largest on the solver's exact cases, dimensionless
  double error_factor = 1;    ///< over the defaults', geometric mean over the cases
  double cost_factor = 1;     ///< computing time over the defaults', likewise
};

/// From draft to reference.
[[nodiscard]] const std::array<QualityPoint, 4>& quality_points(Solver solver);

/// The point of a quality that is not kOwn.
[[nodiscard]] const QualityPoint& quality_point(Solver solver, Quality quality);

/// The numerics of a quality, and the defaults for all that it does not set.
[[nodiscard]] Numerics numerics_of(Solver solver, Quality quality);

/// The scene at that quality: what it says of its numerics itself stays.
[[nodiscard]] Scene with_quality(const Scene& scene, Quality quality);

}  // namespace lather
