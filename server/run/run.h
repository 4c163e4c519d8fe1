#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/plan/plan.h"
#include "sim/report/report.h"

/// A plan to pictures: simulate, draw beside the next steps, write each frame whole. Used by `lather run` and
/// by the runner of a job alike.
namespace lather::server {

struct RunSettings {
  std::filesystem::path frames;  ///< directory of 00000.png …; made if missing
  std::filesystem::path report;  ///< file; written when the run ends in one of its four states
  std::filesystem::path probes;  ///< file, CSV; written with the report when the scene has probes
  int threads = 0;               ///< of a step; 0: all cores
  std::string render_backend = "auto";
  std::filesystem::path files = {};  ///< directory of particles/00000.ply, skin/00000.obj …, those that the
                                     ///< scene asks for; "": none
  std::filesystem::path checkpoints = {};  ///< directory of 000000012345.checkpoint, named by their steps;
                                           ///< "": none
  std::chrono::milliseconds checkpoint_interval{60'000};  ///< wall clock, between two
  /// Checkpoints to go on from, the best first: the first one that can be used is. None can: from the start.
  std::vector<std::filesystem::path> resume_from = {};
};

/// How a run is asked to stop before its end.
enum class Stop { kNo, kNow, kAfterCheckpoint };

struct RunProgress {
  int frame = 0;         ///< the frame being worked towards
  int frames = 0;        ///< pictures in all
  double time = 0;       ///< simulated, s
  double time_step = 0;  ///< s
  double fraction = 0;   ///< of the simulated duration, 0 … 1
  std::uint64_t step = 0;
  double seconds_per_frame = 0;  ///< wall clock, mean so far
  double eta_seconds = -1;       ///< wall clock; negative: not known yet
  double budget_seconds = 0;     ///< of the whole run, wall clock; 0: it has none
  double expected_seconds = -1;  ///< of the whole run at the speed so far; negative: not known yet
};

struct FrameFile {
  int index = 0;
  std::string file;  ///< name within RunSettings::frames
  std::string sha256;
  std::uint64_t size = 0;  ///< bytes
};

struct CheckpointFile {
  std::uint64_t step = 0;
  double time = 0;         ///< simulated, s
  std::uint64_t size = 0;  ///< bytes
};

/// What a run tells while it goes. Calls come one at a time, from two threads.
class RunEvents {
 public:
  virtual ~RunEvents() = default;
  virtual void progress(const RunProgress& progress) = 0;  ///< about ten a second at most
  virtual void frame(const FrameFile& frame) = 0;          ///< the file is whole and on the disk
  /// So is this one. All frames before its time have been told of.
  virtual void checkpoint(const CheckpointFile& checkpoint) = 0;
  virtual void log(const std::string& line) = 0;
};

/// Runs to the end, or until `stop` is set. Report::state is "succeeded", "cancelled" (Stop::kNow), "paused"
/// (Stop::kAfterCheckpoint) or "failed" (then with Report::error); a SimulationError becomes "failed", frames
/// drawn before it are still written. What a run that went on from a checkpoint makes is equal byte for byte
/// to what it would have made without a break. Throws InputError for what the plan or the settings ask and
/// cannot have, std::exception when files or the renderer fail.
[[nodiscard]] Report run(const Plan& plan, const RunSettings& settings, RunEvents& events,
                         const std::atomic<Stop>& stop);

/// "00042.png"
[[nodiscard]] std::string frame_file_name(int index, const std::string& ending = "png");

/// The threads that `wanted` stands for: 0 is all cores.
[[nodiscard]] int thread_count(int wanted);

}  // namespace lather::server
