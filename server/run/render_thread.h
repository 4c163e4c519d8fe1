#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>

#include "server/run/run.h"
#include "sim/frame.h"

namespace lather::server {

/// Draws frames and writes them whole, beside the simulation's next steps. One thread for the whole run,
/// since a drawing context belongs to the thread that made it. At most two frames wait; then push() blocks,
/// so that memory stays bounded when drawing is slower than stepping.
class RenderThread {
 public:
  /// Returns once the drawing context stands; throws what made it fail. `plan` and `events` must outlive
  /// this.
  RenderThread(const Plan& plan, std::filesystem::path frames, const std::string& render_backend, int threads,
               RunEvents& events);
  ~RenderThread();
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  /// False when drawing has failed: there is no use in going on, finish() says why.
  [[nodiscard]] bool push(Frame frame);

  /// Waits until the frames that were pushed are written (or dropped, without `draw_rest`), ends the thread
  /// and throws what made drawing fail, if anything did.
  void finish(bool draw_rest);

  [[nodiscard]] const std::string& backend() const { return backend_; }
  [[nodiscard]] double seconds() const {
    return seconds_;
  }  ///< spent in drawing and encoding; after finish()

 private:
  void main(const std::string& render_backend, int threads);
  bool take(Frame& frame);
  void close(bool draw_rest);

  const Plan& plan_;
  const std::filesystem::path frames_;
  RunEvents& events_;
  const std::string scene_hash_;
  std::string backend_;
  double seconds_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> waiting_;  // guarded by mutex_, as are those below
  bool ready_ = false;
  bool closed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace lather::server
