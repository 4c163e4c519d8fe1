#pragma once

#include <atomic>
#include <filesystem>
#include <vector>

#include "server/run/run.h"
#include "sim/report/report.h"
#include "sim/scene/scene.h"

/// Frames drawn again from the particles that a run kept, with another camera, look or size, and nothing
/// simulated.
namespace lather::server {

/// What may be changed of a scene whose particles are drawn again: pointers below /look and /output. Throws
/// InputError for any other.
void check_redrawn(const std::vector<Override>& overrides);

/// Do the changes name the files of every frame? Else none is written again.
[[nodiscard]] bool asks_for_files(const std::vector<Override>& overrides);

/// The frames to draw again, both ends included.
struct FrameRange {
  int first = 0;
  int last = 1'000'000;
};

/// Draws the frames of `range` that are kept as NNNNN.ply in one of the directories `particles` (a frame is
/// taken from the first that has it); frame 0 must be among what is kept where the camera is automatic, for
/// it is framed by that. With the scene as it was, pictures are equal byte for byte to those of the run.
/// Report::state is "succeeded", "cancelled" or "paused", as run()'s; it holds what drawing took, and no
/// frames' figures. There are no checkpoints of drawing: it starts over. Throws InputError when there are no
/// particles, std::exception when files or the renderer fail.
[[nodiscard]] Report redraw(const Scene& scene, const std::vector<std::filesystem::path>& particles,
                            const FrameRange& range, const RunSettings& settings, RunEvents& events,
                            const std::atomic<Stop>& stop);

}  // namespace lather::server
