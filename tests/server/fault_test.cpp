// What the machine denies: a disk that fails or is full, memory that is not there. Each must end in a clear
// failure, with the server up and the store sound.

#include <SQLiteCpp/SQLiteCpp.h>
#include <sched.h>
#include <sys/mount.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "sim/scene/sha256.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

class Fault : public Blackbox {
 protected:
  long resident_kib(pid_t pid) const {
    std::ifstream status("/proc/" + std::to_string(pid) + "/status");
    std::string line;
    while (std::getline(status, line))
      if (line.rfind("VmRSS:", 0) == 0) return std::stol(line.substr(6));
    return 0;
  }
  /// None when the server refused it.
  std::string try_to_post(const Json& scene) {
    const RawResponse answer = request(port(), "POST", "/api/v1/jobs", scene.dump());
    EXPECT_TRUE(answer.status == 201 || answer.status == 500) << answer.body;
    return answer.status == 201 ? Json::parse(answer.body).at("id").get<std::string>() : std::string();
  }
  /// What the server says while its store fails may be an error; it says it at once.
  std::string state_or_none(const std::string& id) {
    const RawResponse answer = request(port(), "GET", path(id));
    EXPECT_NE(answer.status, 0);
    return answer.status == 200 ? Json::parse(answer.body).value("state", "") : std::string();
  }
  bool succeeds_after_retries(const std::string& id) {
    return eventually([&] {
      const std::string now = state(id);
      if (now == "failed") static_cast<void>(request(port(), "POST", path(id, "/retry")));
      return now == "succeeded";
    });
  }
  void expect_sound_store() {
    EXPECT_EQ(server_->end(SIGTERM), 0);
    SQLite::Database database((data() / "lather.db").string());
    EXPECT_EQ(database.execAndGet("PRAGMA integrity_check").getString(), "ok");
  }
  void expect_whole_frames(const std::string& id) {
    const Json listing = Json::parse(request(port(), "GET", path(id, "/frames")).body);
    for (const Json& row : listing.at("frames"))
      EXPECT_EQ(sha256_hex(request(port(), "GET", row.at("url")).body), row.at("sha256")) << row;
  }
};

TEST_F(Fault, ADiskThatFailsNowAndThenFailsJobsClearlyAndTheStoreStaysSound) {
  ASSERT_EQ(::setenv("LD_PRELOAD", LATHER_FAILING_DISK, 1), 0);
  ASSERT_EQ(::setenv("LATHER_TEST_DISK", data().c_str(), 1), 0);
  start({"--checkpoint-seconds", "0.1"});
  ::unsetenv("LD_PRELOAD");
  ::unsetenv("LATHER_TEST_DISK");
  const std::string undisturbed = post_job(small_scene());
  ASSERT_TRUE(reaches(undisturbed, "succeeded"));
  const long idle = resident_kib(server_->pid());
  std::set<std::string> errors;
  int refused = 0;
  std::vector<std::string> posted;
  for (const int period : {25, 50, 100, 200}) {
    std::ofstream(data() / "fail") << period;
    for (int i = 0; i < 2; ++i) {
      const std::string id = try_to_post(small_scene());
      if (id.empty()) {
        ++refused;
        continue;
      }
      posted.push_back(id);
      // With a store that cannot be written a job may stay where it is until it can be.
      static_cast<void>(eventually(
          [&] {
            const std::string now = state_or_none(id);
            return now == "failed" || now == "succeeded";
          },
          std::chrono::seconds(3)));
    }
    fs::remove(data() / "fail");
    for (const std::string& id : posted) {
      if (state(id) == "failed") errors.insert(job(id).at("error").get<std::string>());
      ASSERT_TRUE(succeeds_after_retries(id)) << job(id);
      EXPECT_EQ(frame_hashes(id), frame_hashes(undisturbed));
      expect_whole_frames(id);
    }
  }
  const long grown = resident_kib(server_->pid()) - idle;
  std::printf(
      "8 posts to a disk that fails: %d refused; %zu sorts of errors of jobs; the server grew by %ld KiB\n",
      refused, errors.size(), grown);
  EXPECT_LT(grown, 32 * 1024);
  for (const std::string& error : errors)
    EXPECT_TRUE(error.find("Input/output error") != std::string::npos ||
                error.find("disk I/O error") != std::string::npos)
        << error;
  expect_sound_store();
}

/// A disk of 8 MB of the test's own, where it may have one: seen by this process and its children alone.
class SmallDisk {
 public:
  explicit SmallDisk(fs::path place) : place_(std::move(place)) {
    fs::create_directories(place_);
    mounted_ = ::unshare(CLONE_NEWNS) == 0 &&
               ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
               ::mount("none", place_.c_str(), "tmpfs", 0, "size=8m") == 0;
  }
  ~SmallDisk() {
    if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  [[nodiscard]] bool mounted() const { return mounted_; }

 private:
  const fs::path place_;
  bool mounted_ = false;
};

TEST_F(Fault, AFullDiskFailsJobsClearlyAndWithRoomTheyGoOn) {
  const SmallDisk disk(data());
  if (!disk.mounted()) GTEST_SKIP() << "not tried: no tmpfs can be mounted here";
  start({"--checkpoint-seconds", "0.1"});
  const std::string undisturbed = post_job(small_scene());
  ASSERT_TRUE(reaches(undisturbed, "succeeded"));
  Json scene = small_scene();
  scene["output"]["width"] = 640;
  scene["output"]["height"] = 360;
  const std::string id = post_job(scene);
  ASSERT_NE(id, "");
  {
    std::ofstream ballast(data() / "ballast", std::ios::binary);
    const std::string piece(4096, 'x');
    while (ballast.write(piece.data(), static_cast<std::streamsize>(piece.size())).flush()) {
    }
  }
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
  // Where the store has no room either, the job stays as it was until there is some.
  const bool failed = eventually([&] { return state_or_none(id) == "failed"; }, std::chrono::seconds(3));
  fs::remove(data() / "ballast");
  if (failed) {
    const std::string error = job(id).at("error");
    EXPECT_TRUE(error.find("No space left on device") != std::string::npos ||
                error.find("disk is full") != std::string::npos)
        << error;
  }
  ASSERT_TRUE(succeeds_after_retries(id)) << job(id);
  expect_whole_frames(id);
  expect_whole_frames(undisturbed);
  expect_sound_store();
}

TEST_F(Fault, AJobThatNeedsMoreMemoryThanARunnerMayHaveFailsAndSaysWhatToDo) {
  start({"--runner-memory", "600000000"});
  Json scene = small_scene();
  scene["spacing"] = 0.0001;
  scene["bodies"][0]["shape"]["radius"] = 0.1;
  const std::string id = post_job(scene);
  const std::string other = post_job(small_scene());
  ASSERT_TRUE(reaches(id, "failed")) << job(id);
  const std::string error = job(id).at("error");
  EXPECT_NE(error.find("out of memory: choose a larger spacing"), std::string::npos) << error;
  EXPECT_EQ(job(id).at("attempt"), 1) << "it would fail again";
  EXPECT_TRUE(reaches(other, "succeeded")) << job(other);
}

}  // namespace
}  // namespace lather::server
