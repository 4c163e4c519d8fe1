#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/study/bench/bench.h"

/// Scenes of papers beside what the papers say they cost.
namespace lather::study {

struct PaperScene {
  std::string name;
  std::string file;                  ///< of the scene, from the directory of the list
  std::vector<std::string> set;      ///< "/json/pointer=value", changes of the scene
  std::string machine;               ///< that the paper used
  double frame_rate = 0;             ///< of the paper's frames, 1/s
  double time_step = 0;              ///< printed, s
  double start = 0;                  ///< when its cost is measured, s of simulated time
  std::optional<double> least = {};  ///< printed cost of a frame, s; none where the paper has no number
  std::optional<double> most = {};   ///< the same, unless a range is printed
};

/// A list of scenes, {"scenes": [{"name", "scene", "set": […], "machine", "frame_rate", "time_step",
/// "start", "seconds_per_frame": [least, most] or null}]}; other members are for people. Throws InputError.
[[nodiscard]] std::vector<PaperScene> read_paper_scenes(std::string_view json);

/// The case that runs `scene`; a round holds whole intervals of resampling. A scene that is measured later
/// than at its start takes the longest steps that its plan allows, so as to get there, and resamples after as
/// many of them as it does of its own: what a step costs hardly depends on its length.
[[nodiscard]] BenchCase paper_case(const PaperScene& paper, const Scene& scene);

/// The steps that `scene` takes to each of its frames, s, as its plan has them.
[[nodiscard]] double step_of(const Scene& scene);

/// A scene that ran.
struct PaperRun {
  PaperScene paper;
  double time_step = 0;  ///< the scene's own, see step_of()
  BenchResult result;

  /// Steps of the scene in a frame of the paper's.
  [[nodiscard]] double steps_per_frame() const { return 1 / (paper.frame_rate * time_step); }
  /// Time for such a frame, s: extrapolated from the rate that was measured to all points of the scene and
  /// all of its steps.
  [[nodiscard]] double seconds_per_frame() const {
    return static_cast<double>(result.points) * steps_per_frame() / result.point_steps_per_second;
  }
};

/// [{"name", "threads", "start", "time_step", "steps_per_frame", "seconds_per_frame", "printed": [least,
/// most] or null}]
[[nodiscard]] Array to_json(const std::vector<PaperRun>& runs);

}  // namespace lather::study
