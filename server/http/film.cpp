#include "server/http/film.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "server/agent/spawn_settings.h"
#include "server/artifacts/owned_fd.h"

namespace lather::server {
namespace {

constexpr int kSilenceMs = 60'000;  // of the encoder, which may need a while for a large picture

[[noreturn]] void fail(int error, const char* what) {
  throw std::system_error(error, std::generic_category(), what);
}

std::vector<std::string> arguments_of(FilmKind kind, double rate) {
  char number[32];
  std::snprintf(number, sizeof number, "%.6g", rate);
  // Both codecs want even sizes.
  std::vector<std::string> words = {"ffmpeg",   "-nostdin", "-loglevel",  "quiet",
                                    "-threads", "2",        "-f",         "image2pipe",
                                    "-c:v",     "png",      "-framerate", number,
                                    "-i",       "pipe:0",   "-vf",        "pad=ceil(iw/2)*2:ceil(ih/2)*2"};
  const std::vector<std::string> mp4 = {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p",
                                        // A pipe cannot be wound back to write the index.
                                        "-movflags", "frag_keyframe+empty_moov+default_base_moof", "-f",
                                        "mp4"};
  const std::vector<std::string> webm = {"-c:v",     "libvpx-vp9", "-crf",      "24",   "-b:v",      "0",
                                         "-row-mt",  "1",          "-deadline", "good", "-cpu-used", "5",
                                         "-pix_fmt", "yuv420p",    "-f",        "webm"};
  const std::vector<std::string>& codec = kind == FilmKind::kMp4 ? mp4 : webm;
  words.insert(words.end(), codec.begin(), codec.end());
  words.emplace_back("pipe:1");
  return words;
}

/// The encoder as a child process, fed and read by one thread.
class Encoder {
 public:
  Encoder(const std::filesystem::path& program, const std::vector<std::string>& words) {
    int in[2];
    int out[2];
    if (::pipe2(in, O_CLOEXEC) != 0) fail(errno, "cannot make a pipe");
    const OwnedFd their_in(in[0]);
    in_ = OwnedFd(in[1]);
    if (::pipe2(out, O_CLOEXEC) != 0) fail(errno, "cannot make a pipe");
    out_ = OwnedFd(out[0]);
    const OwnedFd their_out(out[1]);
    ::fcntl(in_.get(), F_SETFL, O_NONBLOCK);
    SpawnSettings settings;
    ::posix_spawn_file_actions_adddup2(&settings.files, their_in.get(), STDIN_FILENO);
    ::posix_spawn_file_actions_adddup2(&settings.files, their_out.get(), STDOUT_FILENO);
    ::posix_spawn_file_actions_addopen(&settings.files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addclosefrom_np(&settings.files, STDERR_FILENO + 1);
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    std::vector<char*> environment = environment_of_child();
    const int error = ::posix_spawn(&pid_, program.c_str(), &settings.files, &settings.attributes,
                                    arguments.data(), environment.data());
    if (error != 0) {
      pid_ = -1;
      fail(error, "cannot start ffmpeg");
    }
  }
  ~Encoder() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    static_cast<void>(succeeded());
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  bool run(const NextPicture& next, const BodySink& sink) {
    feed_with(next());
    while (true) {
      std::array<pollfd, 2> pipes = {{{in_.get(), POLLOUT, 0}, {out_.get(), POLLIN, 0}}};
      const int ready = ::poll(pipes.data(), pipes.size(), kSilenceMs);
      if (ready < 0 && errno == EINTR) continue;
      if (ready <= 0) return false;
      if (pipes[0].revents != 0 && write_some()) feed_with(next());
      if (pipes[1].revents == 0) continue;
      std::array<char, 65536> piece{};
      const ssize_t got = ::read(out_.get(), piece.data(), piece.size());
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) return false;
      if (got == 0) return succeeded();
      if (!sink({piece.data(), static_cast<std::size_t>(got)})) return false;
    }
  }

 private:
  void feed_with(std::optional<std::string> picture) {
    written_ = 0;
    picture_ = std::move(picture).value_or("");
    if (picture_.empty()) in_.reset();  // that was all
  }

  /// True when the picture is written.
  bool write_some() {
    const ssize_t written = ::write(in_.get(), picture_.data() + written_, picture_.size() - written_);
    if (written < 0 && (errno == EAGAIN || errno == EINTR)) return false;
    if (written < 0) {  // it has ended; what it says last is still read
      in_.reset();
      return false;
    }
    written_ += static_cast<std::size_t>(written);
    return written_ == picture_.size();
  }

  /// Waits for its end.
  bool succeeded() {
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  pid_t pid_ = -1;
  OwnedFd in_;
  OwnedFd out_;
  std::string picture_;
  std::size_t written_ = 0;
};

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const auto usable = [](const std::filesystem::path& file) { return ::access(file.c_str(), X_OK) == 0; };
  if (name.find('/') != std::string::npos)
    return usable(name) ? std::optional(std::filesystem::path(name)) : std::nullopt;
  const char* const variable = std::getenv("PATH");
  std::string_view rest = variable ? variable : "";
  while (!rest.empty()) {
    const std::size_t colon = std::min(rest.find(':'), rest.size());
    const std::filesystem::path file = std::filesystem::path(rest.substr(0, colon)) / name;
    if (file.is_absolute() && usable(file)) return file;
    rest.remove_prefix(std::min(colon + 1, rest.size()));
  }
  return std::nullopt;
}

bool write_film(const std::filesystem::path& ffmpeg, FilmKind kind, double rate, const NextPicture& next,
                const BodySink& sink) {
  return Encoder(ffmpeg, arguments_of(kind, rate)).run(next, sink);
}

}  // namespace lather::server
