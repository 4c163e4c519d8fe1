#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/report/report.h"
#include "sim/scene/scene.h"

/// Does the program stay upright? A scene is run, and every frame of it is held against what no parameters
/// may break.
namespace lather::study {

enum class Outcome {
  kHeld,     ///< it ran to where it was to, and every frame is sound
  kRefused,  ///< InputError: it cannot be planned
  kStopped,  ///< SimulationError, after none but sound frames
  kBroken    ///< a frame that is not sound, or an exception of another type
};

[[nodiscard]] const char* to_string(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::kHeld;
  std::string why;  ///< the error's words, or what is wrong with which frame
  std::uint64_t steps = 0;
  double most_energy = 0;  ///< of any frame, over that of the first one; 0 where there is none to compare
  std::vector<std::uint64_t> fingerprints;  ///< of all points, frame by frame
};

struct Examination {
  std::uint64_t most_steps = 0;  ///< the run ends there, where fast points make its steps short
  int threads = 1;
  bool resumed = false;  ///< at each frame it is saved, and goes on in another simulation that is restored
};

/// Runs the scene to its end and judges each frame by unsoundness().
[[nodiscard]] Verdict examine(const Scene& scene, const Examination& examination);

/// What is wrong with a frame of a run that began with `start`, in words; "" if it is sound:
/// - every figure is a number;
/// - mass is that of the start, with what came in and without what left, to rounding;
/// - all points lie in the domain, along axes that are neither periodic nor open;
/// - energy is at most 1.1 of what it was (or what the scene allows beyond that) and rounding, where nothing
///   can have put any in: half a step lies
///   between the velocities and the strains that it is measured from, so that of a wave it oscillates by a
///   few percent.
[[nodiscard]] std::string unsoundness(const Scene& scene, const FrameMeasure& start, const FrameMeasure& now);

}  // namespace lather::study
