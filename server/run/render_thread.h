#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <variant>

#include "server/run/run.h"
#include "sim/export/frame_files.h"
#include "sim/frame.h"

namespace lather::render {
class Renderer;
}

namespace lather::server {

/// The state of a simulation between two steps, on its way to the disk.
struct Checkpoint {
  std::uint64_t step = 0;
  double time = 0;  ///< simulated, s
  std::string state;
  bool spare =
      false;  ///< nothing is lost without it: when it cannot be written, the log says so, and no more
};

/// Draws frames and writes them whole, with the files that the scene asks for, beside the simulation's next
/// steps; and checkpoints, in the order in which they come: when one is told of, all frames before it are on
/// the disk. One thread for the whole run, since a drawing context belongs to the thread that made it. At
/// most two things wait; then push() blocks, so that memory stays bounded when drawing is slower than
/// stepping.
class RenderThread {
 public:
  /// Returns once the drawing context stands; throws what made it fail. `drawn` and `events` must outlive
  /// this. Of the settings all but the report's file count, and `threads` must be known.
  /// Pictures hold the scene `named`, of which `drawn` is one with its camera framed.
  RenderThread(const Scene& drawn, const Scene& named, const RunSettings& settings, RunEvents& events);
  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  using Item = std::variant<Frame, Checkpoint>;

  /// False when drawing or writing has failed: there is no use in going on, finish() says why.
  [[nodiscard]] bool push(Item item);

  /// Waits until the frames that were pushed are written (or dropped, without `draw_rest`), ends the thread
  /// and throws what made drawing fail, if anything did.
  void finish(bool draw_rest);

  [[nodiscard]] const std::string& backend() const { return backend_; }
  [[nodiscard]] double seconds() const {
    return seconds_;
  }  ///< spent in drawing and making files; after finish()

 private:
  void main();
  void draw(render::Renderer& renderer, const Frame& frame);
  void write(const Frame& frame, const std::string& png);
  void write(const Checkpoint& checkpoint);
  bool take(Item& item);
  void close(bool draw_rest);

  const Scene& scene_;
  const RunSettings settings_;
  const std::vector<FrameFileKind> files_;
  RunEvents& events_;
  const std::string scene_hash_;
  const std::string scene_json_;
  std::string backend_;
  double seconds_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> waiting_;  // guarded by mutex_, as are those below
  bool ready_ = false;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace lather::server
