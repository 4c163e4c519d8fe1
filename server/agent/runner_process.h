#pragma once

#include <sys/types.h>

#include <string>

#include "server/artifacts/owned_fd.h"

namespace lather::server {

/// A runner as a child process: this program again with the hidden command `runner`. Started with
/// posix_spawn, for a fork of a process with threads may hang in OpenMP; it inherits the socket pair's end as
/// descriptor 3 and nothing else that is open here.
class RunnerProcess {
 public:
  /// Throws std::system_error when it cannot be started.
  RunnerProcess();
  ~RunnerProcess();  ///< kills it if it still runs, and waits for it
  RunnerProcess(const RunnerProcess&) = delete;
  RunnerProcess& operator=(const RunnerProcess&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }
  [[nodiscard]] int socket() const { return socket_.get(); }
  [[nodiscard]] int log() const { return log_.get(); }      ///< its stdout and stderr; does not block
  [[nodiscard]] int ended() const { return ended_.get(); }  ///< a pidfd: readable once it has ended

  void kill();
  /// How it ended: by itself with a code, or by a signal (0: none).
  struct End {
    int exit_code = 0;
    int signal = 0;
  };
  [[nodiscard]] End wait();  ///< waits for it

 private:
  pid_t pid_ = -1;
  OwnedFd socket_;
  OwnedFd log_;
  OwnedFd ended_;
};

/// "SIGKILL" for 9, and so on.
[[nodiscard]] std::string signal_name(int signal);

}  // namespace lather::server
