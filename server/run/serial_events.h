#pragma once

#include <mutex>
#include <string>

#include "server/run/run.h"

namespace lather::server {

/// Passes events on one at a time, whichever thread they come from.
class SerialEvents final : public RunEvents {
 public:
  explicit SerialEvents(RunEvents& to) : to_(to) {}
  void progress(const RunProgress& progress) override {
    const std::lock_guard lock(mutex_);
    to_.progress(progress);
  }
  void frame(const FrameFile& frame) override {
    const std::lock_guard lock(mutex_);
    to_.frame(frame);
  }
  void checkpoint(const CheckpointFile& checkpoint) override {
    const std::lock_guard lock(mutex_);
    to_.checkpoint(checkpoint);
  }
  void log(const std::string& line) override {
    const std::lock_guard lock(mutex_);
    to_.log(line);
  }

 private:
  std::mutex mutex_;
  RunEvents& to_;
};

}  // namespace lather::server
