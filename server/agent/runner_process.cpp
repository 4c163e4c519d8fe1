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
#include <string_view>
#include <system_error>
#include <vector>

namespace lather::server {
namespace {

constexpr int kRunnerFd = 3;

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

/// posix_spawn's two settings objects, destroyed whatever happens.
struct SpawnSettings {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnSettings() {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawnattr_init(&attributes);
  }
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
};

/// The server blocks signals in its threads and a terminal's Ctrl-C goes to a whole process group: the runner
/// starts with a clean mask, default actions and a group of its own.
void reset_signals(posix_spawnattr_t& attributes) {
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  ::posix_spawnattr_setsigdefault(&attributes, &all);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
}

void wire_files(posix_spawn_file_actions_t& files, int log, int socket) {
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, log, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log, STDERR_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, socket, kRunnerFd);
  ::posix_spawn_file_actions_addclosefrom_np(&files, kRunnerFd + 1);
}

/// A runner knows no store, so it is not told how to reach one: neither our variable nor those of libpq,
/// which may hold a password.
std::vector<char*> environment_of_runner() {
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (text.substr(0, 2) != "PG" && text.substr(0, 13) != "LATHER_STORE=") kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
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
  reset_signals(settings.attributes);
  wire_files(settings.files, their_log.get(), theirs.get());
  char program[] = "lather";
  char command[] = "runner";
  char* arguments[] = {program, command, nullptr};
  std::vector<char*> environment = environment_of_runner();
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
