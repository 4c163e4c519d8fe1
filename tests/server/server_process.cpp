#include "tests/server/server_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace lather::server {
namespace {

/// stdout up to and with the line that names the port; all of it when the program ends without.
std::string read_until_listening(int fd) {
  std::string text;
  char c = 0;
  while (::read(fd, &c, 1) == 1) {
    text += c;
    if (c == '\n' && text.find("listening on http://") != std::string::npos) break;
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

ServerProcess::ServerProcess(const std::filesystem::path& data, std::vector<std::string> further_arguments) {
  std::vector<std::string> words = {LATHER_PROGRAM, "serve",       "--port",    "0",
                                    "--data",       data.string(), "--threads", "1"};
  words.insert(words.end(), further_arguments.begin(), further_arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int out[2];
  if (::pipe2(out, O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
  const std::string log = (data.parent_path() / "server.log").string();
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, out[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&files, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  const int error = ::posix_spawn(&pid_, LATHER_PROGRAM, &files, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&files);
  ::close(out[1]);
  const std::string said = error == 0 ? read_until_listening(out[0]) : std::string();
  ::close(out[0]);
  const std::size_t place = said.rfind(':');
  if (said.find("listening on") == std::string::npos) {
    end(SIGKILL);
    std::ifstream words_of_error(log);
    std::stringstream all;
    all << words_of_error.rdbuf();
    throw std::runtime_error("the server did not start: " + said + all.str());
  }
  port_ = std::stoi(said.substr(place + 1));
}

ServerProcess::~ServerProcess() {
  end(SIGKILL);
}

std::vector<pid_t> ServerProcess::runners() const {
  std::vector<pid_t> found;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (!std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; })) continue;
    const pid_t candidate = static_cast<pid_t>(std::stol(name));
    if (parent_of(candidate) == pid_) found.push_back(candidate);
  }
  return found;
}

int ServerProcess::end(int signal) {
  if (pid_ <= 0) return 0;
  ::kill(pid_, signal);
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace lather::server
