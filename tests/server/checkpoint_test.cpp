// Checkpoints on the disk, and runs that go on from them.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "server/artifacts/whole_file.h"
#include "server/run/checkpoint_file.h"
#include "server/run/run.h"
#include "sim/scene/scene.h"
#include "tests/server/temporary_directory.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class CheckpointFileTest : public ::testing::Test {
 protected:
  CheckpointFileTest() : file_(directory_.path() / "one.checkpoint") {
    write_checkpoint(file_, state_);
    good_ = bytes_of(file_);
  }
  std::string reason(const std::string& bytes) {
    write_whole(file_, bytes);
    try {
      EXPECT_NE(read_checkpoint(file_), "") << "damage was not seen";
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "none";
  }
  /// With the byte at `offset` changed.
  [[nodiscard]] std::string damaged(std::size_t offset) const {
    std::string bytes = good_;
    bytes[offset] = static_cast<char>(bytes[offset] ^ 1);
    return bytes;
  }

  TemporaryDirectory directory_;
  const fs::path file_;
  const std::string state_ = std::string("state\0with NUL and more", 23);
  std::string good_;
};

TEST_F(CheckpointFileTest, GivesBackWhatWasWritten) {
  EXPECT_EQ(read_checkpoint(file_), state_);
  EXPECT_EQ(write_checkpoint(file_, ""), good_.size() - state_.size());
  EXPECT_EQ(read_checkpoint(file_), "");
  EXPECT_EQ(checkpoint_file_name(12345), "000000012345.checkpoint");
}

TEST_F(CheckpointFileTest, ARefusedFileSaysWhy) {
  EXPECT_EQ(reason(damaged(0)), "it is no checkpoint");
  EXPECT_NE(reason(damaged(8)).find("its form is"), std::string::npos);
  EXPECT_EQ(reason(damaged(16)), "another build of Lather wrote it");
  EXPECT_EQ(reason(damaged(80)), "its length is not what its header says");
  EXPECT_EQ(reason(damaged(90)), "its checksum does not fit its bytes");
  EXPECT_EQ(reason(damaged(good_.size() - 1)), "its checksum does not fit its bytes");
  EXPECT_EQ(reason(good_ + "x"), "its length is not what its header says");
  fs::remove(file_);
  EXPECT_THROW(static_cast<void>(read_checkpoint(file_)), CheckpointError);
  EXPECT_THROW(static_cast<void>(read_checkpoint(directory_.path())), CheckpointError);
}

TEST_F(CheckpointFileTest, EveryFlippedByteAndEveryCutIsSeen) {
  for (std::size_t at = 0; at < good_.size(); ++at) {
    EXPECT_NE(reason(damaged(at)), "none") << at;
    EXPECT_NE(reason(good_.substr(0, at)), "none") << at;
  }
}

TEST(BuildId, IsThatOfTheLinker) {
  EXPECT_EQ(build_id().size(), 40U) << build_id();
  EXPECT_EQ(build_id().find_first_not_of("0123456789abcdef"), std::string::npos) << build_id();
}

/// Keeps what a run tells, and stops it after some frames: in the first step towards the next one, however
/// slow drawing is.
class Recorder final : public RunEvents {
 public:
  Recorder(Stop how, int most_frames) : how_(how), most_(most_frames) {}
  void progress(const RunProgress& told) override {
    if (first_ < 0) first_ = told.frame == 1 ? 0 : told.frame;  // frame 0 takes no step
    if (told.frame - first_ >= most_) stop.store(how_);
  }
  void frame(const FrameFile& frame) override { frames[frame.index] = frame.sha256; }
  void checkpoint(const CheckpointFile& checkpoint) override {
    checkpoints.push_back(checkpoint.step);
    frames_at_checkpoint = frames.size();
  }
  void log(const std::string& line) override { said += line + '\n'; }

  std::map<int, std::string> frames;
  std::vector<std::uint64_t> checkpoints;
  std::size_t frames_at_checkpoint = 0;
  std::string said;
  std::atomic<Stop> stop{Stop::kNo};

 private:
  const Stop how_;
  const int most_;
  int first_ = -1;
};

constexpr const char* kScene2d = R"({"lather": 1, "dimension": 2, "gravity": [0, -9.81],
  "domain": {"min": [-0.16, 0], "max": [0.16, 0.32]}, "duration": 0.2, "frame_rate": 30, "spacing": 0.01,
  "materials": [{"name": "foam", "preset": "shaving-cream"}],
  "bodies": [{"name": "blob", "material": "foam", "shape": {"type": "sphere", "radius": 0.05, "translate": [0, 0.2]}}],
  "emitters": [{"name": "tap", "material": "foam", "velocity": [0, -0.5], "start": 0.01, "interval": 0.05,
    "shape": {"type": "box", "size": [0.03, 0.03], "translate": [0.1, 0.28]}}],
  "probes": [{"type": "walls", "name": "box"}],
  "output": {"width": 160, "height": 120, "particles": ["ply"]}})";

/// With a camera that frames itself: by frame 0, which the second part of a run does not draw.
constexpr const char* kScene3d = R"({"lather": 1, "gravity": [0, -9.81, 0],
  "domain": {"min": [-0.2, 0, -0.2], "max": [0.2, 0.4, 0.2]}, "duration": 0.14, "frame_rate": 30, "spacing": 0.03,
  "materials": [{"name": "foam", "preset": "shaving-cream"}],
  "bodies": [{"name": "blob", "material": "foam", "shape": {"type": "sphere", "radius": 0.07, "translate": [0, 0.2, 0]}}],
  "output": {"width": 160, "height": 120, "skin": ["obj"]}})";

constexpr int kNever = 1'000'000;

class Resume : public ::testing::TestWithParam<const char*> {
 protected:
  Report run_into(const std::string& name, Recorder& recorder, const std::vector<fs::path>& from = {},
                  int threads = 1, const std::string& duration = "") {
    std::vector<Override> changes;
    if (!duration.empty()) changes.push_back({"/duration", duration});
    const fs::path out = directory_.path() / name;
    RunSettings settings;
    settings.frames = out / "frames";
    settings.report = out / "report.json";
    settings.probes = out / "probes.csv";
    settings.threads = threads;
    settings.files = out;
    settings.checkpoints = out / "checkpoints";
    settings.checkpoint_interval = interval_;
    settings.resume_from = from;
    return run(make_plan(parse_scene(GetParam(), "", changes)), settings, recorder, recorder.stop);
  }
  /// Those of a run, the last one first.
  std::vector<fs::path> checkpoints_of(const std::string& name) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(directory_.path() / name / "checkpoints"))
      files.push_back(entry.path());
    std::sort(files.rbegin(), files.rend());
    return files;
  }
  static void damage(const fs::path& file) { write_whole(file, bytes_of(file).substr(0, 200)); }

  TemporaryDirectory directory_;
  std::chrono::milliseconds interval_{0};
};

INSTANTIATE_TEST_SUITE_P(Scenes, Resume, ::testing::Values(kScene2d, kScene3d), [](const auto& test) {
  return test.param == kScene2d ? "Dropping2d" : "AutomaticCamera3d";
});

TEST_P(Resume, FramesReportAndProbesAreThoseOfAnUndisturbedRun) {
  Recorder whole(Stop::kNo, kNever);
  const Report expected = run_into("whole", whole);
  ASSERT_EQ(expected.state, "succeeded");

  Recorder first(Stop::kAfterCheckpoint, 2);
  ASSERT_EQ(run_into("first", first).state, "paused");
  EXPECT_EQ(first.frames_at_checkpoint, first.frames.size()) << "frames come before the checkpoint";
  Recorder second(Stop::kAfterCheckpoint, 1);
  ASSERT_EQ(run_into("second", second, checkpoints_of("first"), 2).state, "paused");
  Recorder third(Stop::kNo, kNever);
  const Report report = run_into("third", third, checkpoints_of("second"));
  ASSERT_EQ(report.state, "succeeded");

  std::map<int, std::string> frames = first.frames;
  for (const Recorder* more : {&second, &third})
    for (const auto& frame : more->frames)
      EXPECT_TRUE(frames.insert(frame).second) << "frame " << frame.first << " was drawn twice";
  EXPECT_EQ(frames, whole.frames);
  ASSERT_EQ(report.frames.size(), expected.frames.size());
  for (std::size_t i = 0; i < report.frames.size(); ++i)
    EXPECT_EQ(report.frames[i].fingerprint, expected.frames[i].fingerprint) << i;
  EXPECT_EQ(report.steps, expected.steps);
  EXPECT_EQ(bytes_of(directory_.path() / "third" / "probes.csv"),
            bytes_of(directory_.path() / "whole" / "probes.csv"));
}

TEST_P(Resume, DamagedCheckpointsFallBackToOlderOnesThenToTheStart) {
  Recorder first(Stop::kAfterCheckpoint, 3);
  ASSERT_EQ(run_into("first", first).state, "paused");
  std::vector<fs::path> files = checkpoints_of("first");
  ASSERT_GE(files.size(), 2U);
  files.resize(2);
  damage(files[0]);
  Recorder second(Stop::kAfterCheckpoint, 1);
  ASSERT_EQ(run_into("second", second, files).state, "paused");
  EXPECT_NE(second.said.find(files[0].filename().string() + " is of no use"), std::string::npos);
  EXPECT_NE(second.said.find("goes on from the checkpoint " + files[1].filename().string()),
            std::string::npos)
      << second.said;
  damage(files[1]);
  Recorder third(Stop::kAfterCheckpoint, 1);
  static_cast<void>(run_into("third", third, files));
  EXPECT_NE(third.said.find("from the start"), std::string::npos) << third.said;
  EXPECT_EQ(third.frames.begin()->first, 0);
  EXPECT_EQ(third.frames.begin()->second, first.frames.at(0));
}

TEST_P(Resume, AnotherScenesCheckpointIsNotTaken) {
  write_checkpoint(directory_.path() / "other", "the state of something else");
  Recorder recorder(Stop::kNow, 1);
  static_cast<void>(run_into("first", recorder, {directory_.path() / "other"}));
  EXPECT_NE(recorder.said.find("other is of no use"), std::string::npos) << recorder.said;
  EXPECT_NE(recorder.said.find("from the start"), std::string::npos);
}

TEST_P(Resume, AFinishedRunGoesOnLongerAsIfItHadNeverEnded) {
  interval_ = std::chrono::hours(1);
  Recorder longer(Stop::kNo, kNever);
  const Report expected = run_into("longer", longer, {}, 1, "0.27");
  Recorder first(Stop::kNo, kNever);
  const Report before = run_into("first", first);
  ASSERT_EQ(first.checkpoints.size(), 1U) << "the end has one, whatever the interval";
  EXPECT_EQ(first.checkpoints[0], before.steps);
  Recorder second(Stop::kNo, kNever);
  const Report report = run_into("second", second, checkpoints_of("first"), 1, "0.27");
  ASSERT_EQ(second.frames.size(), longer.frames.size() - first.frames.size());
  for (const auto& [index, sha] : second.frames) EXPECT_EQ(sha, longer.frames.at(index)) << index;
  ASSERT_EQ(report.frames.size(), expected.frames.size());
  for (std::size_t i = 0; i < report.frames.size(); ++i)
    EXPECT_EQ(report.frames[i].fingerprint, expected.frames[i].fingerprint) << i;
}

}  // namespace
}  // namespace lather::server
