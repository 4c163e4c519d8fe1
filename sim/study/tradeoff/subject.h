#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/simulation.h"
#include "sim/study/tradeoff/knobs.h"

/// What a trade is measured on: exact solutions, or a scene against its own finest run.
namespace lather::study {

/// How far a run is from what it should be, by one measure.
struct Measure {
  std::string what;
  double error = 0;  ///< dimensionless
};

/// Looks at a run, frame by frame, and judges it at the end.
class Watch {
 public:
  virtual ~Watch() = default;
  virtual void see(const Simulation& simulation) = 0;  ///< at every frame, the first included
  [[nodiscard]] virtual std::vector<Measure> measures() const = 0;
};

struct Subject {
  std::string name;
  std::string error_of;  ///< what the error is, one line
  bool exact = false;    ///< else against its own finest run
  /// Throws InputError where the settings are not for it.
  std::function<Scene(const Settings&)> scene;
  std::function<std::unique_ptr<Watch>(const Scene&)> watch;
};

/// The exact solutions of `lather verify` that are small enough to be run at many settings. All their
/// numerics are a scene's defaults, the blends at their shares per step.
[[nodiscard]] const std::vector<Subject>& exact_subjects();

/// A scene against its finest run, which it runs here: half the spacing, half the step and double precision.
/// The error is the largest of: the way of the centre of mass; that of the fronts, the body's extremes along
/// the axes; where it tears, the time of the first torn point; and what of the mass lies elsewhere at the
/// end, in cells two spacings wide. Lengths are over the extent at the start, times over the duration.
[[nodiscard]] Subject scene_subject(const Scene& scene, int threads);

/// The settings of that finest run.
[[nodiscard]] Settings finest_settings(const Scene& scene);

}  // namespace lather::study
