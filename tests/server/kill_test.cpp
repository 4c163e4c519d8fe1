// Runners, servers and both are killed at random moments; nothing that was acknowledged may be lost.

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/scene/sha256.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr int kFramesOfJob = 8;
constexpr std::size_t kUnfinishedAtOnce = 3;

enum class Victim { kRunner, kServer, kBoth };

/// What a client knows of a job: only what a whole answer has told it.
struct KnownJob {
  std::string key;  ///< its Idempotency-Key
  std::string id;   ///< "" until it is acknowledged
  std::map<int, std::string> frames;
  bool finished = false;
};

/// What the issue counts; all of them must stay 0.
struct Damage {
  int jobs_lost = 0;
  int frames_lost = 0;  ///< or changed
  int torn = 0;         ///< files whose bytes are not those of their row
  int duplicates = 0;   ///< jobs of one key, or frames kept twice
  int leftovers = 0;    ///< half-written files and files that no row names
};

class Kills : public Blackbox {
 protected:
  void run_rounds(int rounds, unsigned seed) {
    random_.seed(seed);
    start_server();
    hashes_ = hashes_of_undisturbed();
    for (int round = 0; round < rounds; ++round) {
      ASSERT_TRUE(work_off(kUnfinishedAtOnce));
      while (unfinished() < kUnfinishedAtOnce) post_new();
      watch_for(milliseconds(std::uniform_int_distribution<>(0, 500)(random_)));
      strike(static_cast<Victim>(round % 3));
      ASSERT_NO_FATAL_FAILURE(look_at_all());
    }
    finish();
    for (const char* state : {"queued", "running", "failed", "cancelled"})
      EXPECT_EQ(count(state), 0U) << state;
    report(rounds, seed);
  }

 private:
  static Json scene_of_job() { return scene((kFramesOfJob - 1) / 30.0 + 0.001); }

  void start_server(const std::string& workers = "2") {
    start({"--workers", workers, "--checkpoint-seconds", "0.05"});
  }

  /// The document of a whole answer; none when the server is gone or ended in the middle of it.
  std::optional<Json> ask(const std::string& method, const std::string& target, const std::string& body = {},
                          const std::string& header_lines = {}) {
    try {
      const RawResponse answer = request(port(), method, target, body, header_lines);
      if (answer.status < 200 || answer.status > 299) return std::nullopt;
      Json document = Json::parse(answer.body, nullptr, false);
      return document.is_discarded() ? std::nullopt : std::optional(std::move(document));
    } catch (const std::runtime_error&) {
      return std::nullopt;
    }
  }

  std::vector<std::string> hashes_of_undisturbed() {
    const std::string id = post_job(scene_of_job());
    EXPECT_TRUE(reaches(id, "succeeded")) << job(id);
    ++others_;
    return frame_hashes(id);
  }

  std::size_t unfinished() const {
    std::size_t count = 0;
    for (const KnownJob& known : jobs_) count += known.finished ? 0 : 1;
    return count;
  }

  void post(KnownJob& known) {
    const auto answer =
        ask("POST", "/api/v1/jobs", scene_of_job().dump(), "Idempotency-Key: " + known.key + "\r\n");
    if (answer) known.id = answer->at("id");
  }
  void post_new() {
    jobs_.push_back({"key-" + std::to_string(jobs_.size()), "", {}, false});
    post(jobs_.back());
    EXPECT_NE(jobs_.back().id, "");
  }

  /// Learns which frames are acknowledged, until then.
  void watch_for(milliseconds time) {
    const auto end = std::chrono::steady_clock::now() + time;
    do {
      for (KnownJob& known : jobs_)
        if (!known.finished) learn_frames(known);
      std::this_thread::sleep_for(milliseconds(5));
    } while (std::chrono::steady_clock::now() < end);
  }
  void learn_frames(KnownJob& known) {
    const auto listing = ask("GET", path(known.id, "/frames"));
    if (!listing) return;
    for (const Json& row : listing->at("frames")) known.frames[row.at("index")] = row.at("sha256");
  }

  void strike(Victim victim) {
    ++strikes_[victim];
    if (victim != Victim::kServer)
      for (const pid_t runner : server_->runners()) ::kill(runner, SIGKILL);
    if (victim == Victim::kRunner) return;
    // A job is being posted at that moment; without an answer it is posted again, under the same key.
    jobs_.push_back({"key-" + std::to_string(jobs_.size()), "", {}, false});
    KnownJob posted = jobs_.back();
    std::thread client([&] { post(posted); });
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(0, 60000)(random_)));
    server_->end(SIGKILL);
    client.join();
    start_server("0");
    count_leftovers();  // nobody is at work: what lies there now is left over
    jobs_.back().id = posted.id;
    if (posted.id.empty()) {
      ++unanswered_;
      post(jobs_.back());
    }
    start_server();
  }

  void count_leftovers() {
    for (const auto& entry : fs::directory_iterator(data() / "jobs")) {
      const std::string id = entry.path().filename();
      const auto listing = ask("GET", path(id, "/frames"));
      if (!listing) {
        ++damage_.leftovers;  // of a job that does not exist
        continue;
      }
      int pictures = 0;
      int checkpoints = 0;
      for (const auto& file : fs::recursive_directory_iterator(entry.path())) {
        const std::string end = file.path().extension();
        damage_.leftovers += end == ".part" ? 1 : 0;
        pictures += end == ".png" ? 1 : 0;
        checkpoints += end == ".checkpoint" ? 1 : 0;
      }
      const int rows = static_cast<int>(listing->at("frames").size());
      damage_.leftovers += std::max(0, pictures - rows) + std::max(0, checkpoints - 2);
    }
  }

  /// Every job and frame that was ever acknowledged is there.
  void look_at_all() {
    for (KnownJob& known : jobs_) {
      ASSERT_NE(known.id, "");
      if (known.finished) continue;
      const auto now = ask("GET", path(known.id));
      if (!now) {
        ++damage_.jobs_lost;
        known.finished = true;
        continue;
      }
      // Three kills can come before the first checkpoint; a user then tries again.
      if (now->at("state") == "failed") {
        ++retries_;
        EXPECT_TRUE(ask("POST", path(known.id, "/retry")));
      }
      const std::map<int, std::string> before = known.frames;
      learn_frames(known);
      for (const auto& [index, sha] : before) damage_.frames_lost += known.frames[index] == sha ? 0 : 1;
      for (const auto& [index, sha] : known.frames)
        damage_.torn += sha256_hex(bytes(known.id, index)) == sha ? 0 : 1;
      known.finished = now->at("state") == "succeeded";
    }
  }
  std::string bytes(const std::string& id, int index) {
    return request(port(), "GET", path(id, "/frames/" + std::to_string(index) + ".png")).body;
  }

  /// Until so few jobs are left.
  bool work_off(std::size_t left) {
    return eventually([&] {
      if (unfinished() > left) look_at_all();
      return unfinished() <= left || HasFatalFailure();
    });
  }

  void finish() {
    ASSERT_TRUE(work_off(0));
    for (KnownJob& known : jobs_) {
      learn_frames(known);
      std::vector<std::string> hashes;
      for (const auto& [index, sha] : known.frames) {
        hashes.push_back(sha);
        damage_.torn += sha256_hex(bytes(known.id, index)) == sha ? 0 : 1;
      }
      EXPECT_EQ(hashes, hashes_) << "of job " << known.key;
      frames_ += static_cast<int>(hashes.size());
      int pictures = 0;
      for (const auto& file : fs::recursive_directory_iterator(data() / "jobs" / known.id))
        pictures += file.path().extension() == ".png" ? 1 : 0;
      damage_.duplicates += std::max(0, pictures - kFramesOfJob);
    }
    damage_.duplicates += static_cast<int>(count("succeeded")) - static_cast<int>(jobs_.size()) - others_;
    count_leftovers();
  }

  std::size_t count(const std::string& state) {
    std::size_t jobs = 0;
    std::string cursor;
    do {
      const Json page = ask("GET", "/api/v1/jobs?limit=200&state=" + state + cursor).value();
      jobs += page.at("jobs").size();
      cursor = page.at("next_cursor").is_null() ? "" : "&cursor=" + page.at("next_cursor").get<std::string>();
    } while (!cursor.empty());
    return jobs;
  }

  void report(int rounds, unsigned seed) {
    std::printf(
        "%d rounds (seed %u): %d times runners were killed, %d the server, %d both; %zu jobs, %d frames "
        "acknowledged, %d posts cut off, %d retries; lost %d jobs, %d frames; torn %d; duplicates %d; "
        "leftovers %d\n",
        rounds, seed, strikes_[Victim::kRunner], strikes_[Victim::kServer], strikes_[Victim::kBoth],
        jobs_.size(), frames_, unanswered_, retries_, damage_.jobs_lost, damage_.frames_lost, damage_.torn,
        damage_.duplicates, damage_.leftovers);
    EXPECT_EQ(damage_.jobs_lost, 0);
    EXPECT_EQ(damage_.frames_lost, 0);
    EXPECT_EQ(damage_.torn, 0);
    EXPECT_EQ(damage_.duplicates, 0);
    EXPECT_EQ(damage_.leftovers, 0);
  }

  std::mt19937 random_;
  std::vector<std::string> hashes_;
  std::vector<KnownJob> jobs_;
  std::map<Victim, int> strikes_;
  Damage damage_;
  int others_ = 0;
  int frames_ = 0;
  int unanswered_ = 0;
  int retries_ = 0;
};

TEST_F(Kills, OfTenRoundsLoseNothing) {
  run_rounds(10, 7);
}

TEST_F(Kills, OfTwoHundredRoundsLoseNothing) {
  run_rounds(200, 2027);
}

}  // namespace
}  // namespace lather::server
