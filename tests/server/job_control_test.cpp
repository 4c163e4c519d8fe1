// Jobs that are paused, tried again, made longer, and that go on after what happens to them.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "render/render.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

namespace fs = std::filesystem;

class JobControl : public Blackbox {
 protected:
  /// With checkpoints so often that every break has one before it.
  void start_with_checkpoints(std::vector<std::string> further = {}) {
    further.insert(further.end(), {"--checkpoint-seconds", "0.05"});
    start(std::move(further));
  }
  static Json scene_of_16_frames() { return scene(0.5); }

  int act(const std::string& id, const std::string& what, const Json& body = nullptr) {
    return request(port(), "POST", path(id, '/' + what), body.is_null() ? "" : body.dump()).status;
  }
  std::string log(const std::string& id) { return request(port(), "GET", path(id, "/log")).body; }

  /// Waits until it works, and has made some frames.
  pid_t runner_of(const std::string& id, int frames) {
    EXPECT_TRUE(has_frames(id, frames)) << job(id);
    std::vector<pid_t> runners;
    EXPECT_TRUE(eventually([&] { return (runners = server_->runners()).size() == 1; }));
    return runners.empty() ? -1 : runners[0];
  }
  /// What a job that nothing disturbs makes of the scene.
  std::vector<std::string> hashes_of_undisturbed(const Json& scene) {
    const std::string id = post_job(scene);
    EXPECT_TRUE(reaches(id, "succeeded")) << job(id);
    return frame_hashes(id);
  }
  /// Pictures and checkpoints below the job's directory, and anything half-written.
  std::vector<std::string> files_of(const std::string& id) {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(data() / "jobs" / id)) {
      const std::string end = entry.path().extension();
      if (end == ".png" || end == ".checkpoint" || end == ".part") files.push_back(entry.path().filename());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  fs::path last_checkpoint(const std::string& id) {
    std::set<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(data() / "jobs" / id))
      if (entry.path().extension() == ".checkpoint") found.insert(entry.path());
    EXPECT_FALSE(found.empty());
    return found.empty() ? fs::path() : *found.rbegin();
  }
};

TEST_F(JobControl, APausedJobFreesItsWorkerAndGoesOnWithTheSameBytes) {
  start_with_checkpoints();
  const std::vector<std::string> hashes = hashes_of_undisturbed(scene_of_16_frames());
  const std::string id = post_job(scene_of_16_frames());
  ASSERT_TRUE(has_frames(id, 3));
  EXPECT_EQ(act(id, "pause"), 202);
  ASSERT_TRUE(reaches(id, "paused")) << job(id);
  EXPECT_EQ(act(id, "pause"), 202) << "a repeated request is no error";
  EXPECT_GT(job(id).at("checkpoint_time"), 0);
  EXPECT_LT(job(id).at("frames"), 16);
  const std::string other = post_job(small_scene());
  EXPECT_TRUE(reaches(other, "succeeded")) << "its worker is free";
  EXPECT_EQ(state(id), "paused");
  EXPECT_EQ(act(id, "resume"), 202);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(frame_hashes(id), hashes);
  EXPECT_EQ(job(id).at("attempt"), 2);
  EXPECT_NE(log(id).find("goes on from the checkpoint"), std::string::npos) << log(id);
  const Json report = Json::parse(request(port(), "GET", path(id, "/report")).body);
  EXPECT_EQ(report.at("frames").size(), hashes.size()) << "the report is of the whole run";
  EXPECT_EQ(files_of(id).size(), hashes.size() + 1) << "each frame once, and the last checkpoint";
}

TEST_F(JobControl, AQueuedJobPausesAtOnceAndAPausedOneCanBeCancelled) {
  start({"--workers", "0"});
  const std::string id = post_job(small_scene());
  EXPECT_EQ(act(id, "resume"), 409);
  EXPECT_EQ(act(id, "retry"), 409);
  EXPECT_EQ(act(id, "extend", {{"duration", 5}}), 409);
  EXPECT_EQ(act(id, "pause"), 202);
  EXPECT_EQ(state(id), "paused");
  EXPECT_EQ(request(port(), "DELETE", path(id)).status, 409);
  EXPECT_EQ(act(id, "resume"), 202);
  EXPECT_EQ(state(id), "queued");
  EXPECT_EQ(act(id, "pause"), 202);
  EXPECT_EQ(act(id, "cancel"), 202);
  EXPECT_EQ(state(id), "cancelled");
  EXPECT_EQ(act(id, "pause"), 409);
  EXPECT_EQ(act(id, "resume"), 409);
  EXPECT_EQ(act(id, "retry"), 202);
  EXPECT_EQ(state(id), "queued");
  EXPECT_TRUE(job(id).at("ended").is_null());
}

TEST_F(JobControl, ThePriorityOfAWaitingJobMayChange) {
  start({"--workers", "0"});
  const std::string id = post_job(small_scene());
  EXPECT_EQ(act(id, "priority", {{"priority", 7}}), 200);
  EXPECT_EQ(job(id).at("priority"), 7);
  EXPECT_EQ(act(id, "priority", {{"priority", 101}}), 422);
  EXPECT_EQ(act(id, "priority", {{"importance", 1}}), 422);
  EXPECT_EQ(act(id, "priority", 7), 422);
  EXPECT_EQ(act(id, "cancel"), 202);
  EXPECT_EQ(act(id, "priority", {{"priority", 8}}), 409);
}

TEST_F(JobControl, AKilledRunnersJobGoesOnFromItsCheckpointWithTheSameBytes) {
  start_with_checkpoints();
  const std::vector<std::string> hashes = hashes_of_undisturbed(scene_of_16_frames());
  const std::string id = post_job(scene_of_16_frames());
  ASSERT_TRUE(eventually([&] { return !job(id).at("checkpoint_time").is_null(); }));
  ASSERT_EQ(::kill(runner_of(id, 2), SIGKILL), 0);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(frame_hashes(id), hashes);
  EXPECT_EQ(job(id).at("attempt"), 2);
  EXPECT_NE(log(id).find("goes on from the checkpoint"), std::string::npos) << log(id);
  EXPECT_EQ(files_of(id).size(), hashes.size() + 1) << "each frame once, and the last checkpoint";
}

TEST_F(JobControl, AJobThatLosesThreeRunnersFailsAloneAndIsTriedAgain) {
  start({"--checkpoint-seconds", "3600"});
  const std::string victim = post_job(long_scene());
  const std::string next = post_job(small_scene());
  for (int attempt = 1; attempt <= 3; ++attempt) {
    ASSERT_TRUE(eventually([&] { return job(victim).at("attempt") == attempt; }));
    ASSERT_EQ(::kill(runner_of(victim, 1), SIGKILL), 0);
  }
  ASSERT_TRUE(reaches(victim, "failed"));
  const std::string error = job(victim).at("error");
  EXPECT_NE(error.find("3 attempts in a row"), std::string::npos) << error;
  EXPECT_NE(error.find("SIGKILL"), std::string::npos) << error;
  const RawResponse frame = request(port(), "GET", path(victim, "/frames/0.png"));
  EXPECT_EQ(render::decode_png(frame.body).width, 160) << "frames made before stay";
  EXPECT_TRUE(reaches(next, "succeeded")) << job(next);
  EXPECT_EQ(act(victim, "retry"), 202);
  EXPECT_TRUE(eventually([&] { return job(victim).at("attempt") == 4; }));
  EXPECT_TRUE(job(victim).at("error").is_null());
}

TEST_F(JobControl, AFrozenRunnerIsReplaced) {
  start_with_checkpoints({"--lease-seconds", "2"});
  const std::string id = post_job(scene_of_16_frames());
  const pid_t frozen = runner_of(id, 2);
  ASSERT_EQ(::kill(frozen, SIGSTOP), 0);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(job(id).at("attempt"), 2);
  EXPECT_NE(::kill(frozen, SIGCONT), 0) << "it is gone";
}

TEST_F(JobControl, SigtermDrainsWithACheckpointFromWhichTheNextServerGoesOn) {
  start({"--checkpoint-seconds", "3600"});
  const std::vector<std::string> hashes = hashes_of_undisturbed(scene_of_16_frames());
  const std::string id = post_job(scene_of_16_frames());
  ASSERT_TRUE(has_frames(id, 2));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(server_->end(SIGTERM), 0);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  start({"--workers", "0"});
  EXPECT_EQ(state(id), "queued");
  EXPECT_GT(job(id).at("checkpoint_time"), 0);
  start();
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_NE(log(id).find("goes on from the checkpoint"), std::string::npos) << log(id);
  EXPECT_EQ(frame_hashes(id), hashes);
}

TEST_F(JobControl, ADamagedCheckpointCostsTimeButNoByte) {
  start_with_checkpoints();
  const std::vector<std::string> hashes = hashes_of_undisturbed(scene_of_16_frames());
  const std::string id = post_job(scene_of_16_frames());
  ASSERT_TRUE(has_frames(id, 3));
  EXPECT_EQ(act(id, "pause"), 202);
  ASSERT_TRUE(reaches(id, "paused")) << job(id);
  fs::resize_file(last_checkpoint(id), 1000);
  EXPECT_EQ(act(id, "resume"), 202);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_NE(log(id).find("is of no use: its length"), std::string::npos) << log(id);
  EXPECT_NE(log(id).find("goes on from the checkpoint"), std::string::npos) << log(id);
  EXPECT_EQ(frame_hashes(id), hashes);
}

TEST_F(JobControl, AFinishedJobIsMadeLonger) {
  start();
  Json scene = small_scene();
  scene["output"]["particles"] = {"ply"};
  const std::string id = post_job(scene);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  const std::vector<std::string> before = frame_hashes(id);
  EXPECT_EQ(act(id, "extend", {{"duration", 0.1}}), 422) << "no longer than it is";
  EXPECT_EQ(act(id, "extend", {{"duration", "long"}}), 422);
  EXPECT_EQ(act(id, "extend", {{"duration", 1e9}}), 422) << "beyond the limits";
  EXPECT_EQ(act(id, "extend", {{"seconds", 1}}), 422);
  EXPECT_EQ(act(id, "resume"), 409);
  EXPECT_EQ(act(id, "retry"), 409);
  EXPECT_EQ(state(id), "succeeded");
  ASSERT_EQ(act(id, "extend", {{"duration", 0.24}}), 202);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_NE(log(id).find("goes on from the checkpoint"), std::string::npos) << log(id);
  const std::vector<std::string> after = frame_hashes(id);
  ASSERT_EQ(after.size(), 8U);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin())) << "what was made stays as it was";
  scene["duration"] = 0.24;
  const std::vector<std::string> undisturbed = hashes_of_undisturbed(scene);
  EXPECT_TRUE(std::equal(after.begin() + 4, after.end(), undisturbed.begin() + 4));
  EXPECT_EQ(Json::parse(request(port(), "GET", path(id, "/plan")).body).at("frames"), 8);
  // Its particles lie in two attempts' directories.
  EXPECT_EQ(request(port(), "GET", path(id, "/particles/1.ply")).status, 200);
  EXPECT_EQ(request(port(), "GET", path(id, "/particles/7.ply")).status, 200);
  const RawResponse again = request(port(), "POST", path(id, "/render"), "{}");
  ASSERT_EQ(again.status, 201) << again.body;
  const std::string drawn = Json::parse(again.body).at("id");
  ASSERT_TRUE(reaches(drawn, "succeeded")) << job(drawn);
  EXPECT_EQ(frame_hashes(drawn).size(), after.size());
  EXPECT_EQ(frame_hashes(drawn)[7], after[7]);
  EXPECT_EQ(act(drawn, "extend", {{"duration", 1}}), 409);
}

}  // namespace
}  // namespace lather::server
