#include "tests/server/program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lather::server {
namespace {

/// stdout up to and with the line that holds `ready`; all of it when the program ends without.
std::string read_until(int fd, const std::string& ready) {
  std::string text;
  char c = 0;
  while (::read(fd, &c, 1) == 1) {
    text += c;
    if (c == '\n' && text.find(ready) != std::string::npos) break;
  }
  return text;
}

pid_t parent_of(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(stat, text);
  const std::size_t name_end = text.rfind(')');  // the name may hold spaces
  if (name_end == std::string::npos) return -1;
  std::istringstream rest(text.substr(name_end + 1));
  char state = 0;
  pid_t parent = -1;
  rest >> state >> parent;
  return state == 'Z' ? -1 : parent;
}

}  // namespace

Program::Program(std::vector<std::string> arguments, const std::filesystem::path& log,
                 const std::string& ready) {
  arguments.insert(arguments.begin(), LATHER_PROGRAM);
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);

  int out[2];
  if (::pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int error = ::posix_spawn(&pid_, LATHER_PROGRAM, &files, nullptr, words.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::close(out[1]);
  if (error == 0) said_ = read_until(out[0], ready);
  ::close(out[0]);
  if (said_.find(ready) != std::string::npos) return;
  end(SIGKILL);
  std::ifstream words_of_error(log);
  std::stringstream all;
  all << words_of_error.rdbuf();
  throw std::runtime_error("lather " + arguments[1] + " did not start: " + said_ + all.str());
}

Program::~Program() {
  end(SIGKILL);
}

std::vector<pid_t> Program::runners() const {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) continue;
    const pid_t candidate = static_cast<pid_t>(std::stol(name));
    if (parent_of(candidate) == pid_) found.push_back(candidate);
  }
  return found;
}

int Program::end(int signal) {
  if (pid_ <= 0) return 0;
  ::kill(pid_, signal);
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace lather::server
