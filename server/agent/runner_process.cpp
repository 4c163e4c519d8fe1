#include "server/agent/runner_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <vector>

#include "server/agent/spawn_settings.h"

namespace lather::server {
namespace {

constexpr int kRunnerFd = 3;

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

void wire_files(posix_spawn_file_actions_t& files, int log, int socket) {
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, log, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log, STDERR_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, socket, kRunnerFd);
  ::posix_spawn_file_actions_addclosefrom_np(&files, kRunnerFd + 1);
}

}  // namespace

RunnerProcess::RunnerProcess() {
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
    fail(errno, "cannot make a socket pair");
  socket_ = OwnedFd(pair[0]);
  const OwnedFd theirs(pair[1]);
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) fail(errno, "cannot make a pipe");
  log_ = OwnedFd(pipe[0]);
  const OwnedFd their_log(pipe[1]);
  ::fcntl(log_.get(), F_SETFL, O_NONBLOCK);

  SpawnSettings settings;
  wire_files(settings.files, their_log.get(), theirs.get());
  char program[] = "lather";
  char command[] = "runner";
  char* arguments[] = {program, command, nullptr};
  std::vector<char*> environment = environment_of_child();
  const int error = ::posix_spawn(&pid_, "/proc/self/exe", &settings.files, &settings.attributes, arguments,
                                  environment.data());
  if (error != 0) {
    pid_ = -1;
    fail(error, "cannot start a runner");
  }
  ended_ = OwnedFd(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
  if (!ended_) {
    const int reason = errno;
    kill();
    static_cast<void>(wait());
    fail(reason, "cannot watch a runner");
  }
}

RunnerProcess::~RunnerProcess() {
  if (pid_ < 0) return;
  kill();
  static_cast<void>(wait());
}

void RunnerProcess::kill() {
  if (pid_ > 0) ::kill(pid_, SIGKILL);
}

RunnerProcess::End RunnerProcess::wait() {
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

std::string signal_name(int signal) {
  const char* name = ::sigabbrev_np(signal);
  return name ? std::string("SIG") + name : "signal " + std::to_string(signal);
}

}  // namespace lather::server
