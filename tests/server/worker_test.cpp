#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "render/render.h"
#include "tests/server/blackbox.h"
#include "tests/server/postgres_cluster.h"

namespace lather::server {
namespace {

/// A server that only takes and serves, and workers in processes of their own; between them PostgreSQL and a
/// directory.
class Workers : public Blackbox {
 protected:
  Workers() { start({"--store", store_, "--workers", "0"}); }

  std::unique_ptr<Program> start_worker() {
    const std::vector<std::string> arguments = {
        "worker", "--store",         store_, "--artifacts",          data().string(), "--threads",
        "1",      "--lease-seconds", "2",    "--checkpoint-seconds", "0.05"};
    return std::make_unique<Program>(arguments, directory_.path() / "worker.log", "working on");
  }
  static std::string environment_of(pid_t pid) {
    std::ifstream file("/proc/" + std::to_string(pid) + "/environ", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  int pictures_of(const std::string& id) {
    int pictures = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(data() / "jobs" / id))
      pictures += file.path().extension() == ".png" ? 1 : 0;
    return pictures;
  }
  static Json scene_of_13_frames() {
    Json scene = small_scene();
    scene["duration"] = 0.4;
    return scene;
  }
  void expect_all_frames(const std::string& id, int frames) {
    EXPECT_EQ(job(id).at("frames"), frames);
    for (int index = 0; index < frames; ++index) {
      const RawResponse response =
          request(port(), "GET", path(id, "/frames/" + std::to_string(index) + ".png"));
      ASSERT_EQ(response.status, 200) << response.body;
      EXPECT_EQ(render::decode_png(response.body).width, 160);
    }
  }

  PostgresCluster cluster_;
  const std::string store_ = cluster_.new_database();
};

TEST_F(Workers, DoEachJobOnceAndTheServerServesAllFrames) {
  std::vector<std::string> ids;
  for (int i = 0; i < 4; ++i) ids.push_back(post_job(small_scene()));
  const std::unique_ptr<Program> one = start_worker();
  const std::unique_ptr<Program> other = start_worker();
  for (const std::string& id : ids) {
    ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
    EXPECT_EQ(job(id).at("attempt"), 1);
    expect_all_frames(id, 4);
    EXPECT_EQ(Json::parse(request(port(), "GET", path(id, "/report")).body).at("state"), "succeeded");
  }
}

TEST_F(Workers, FinishTheJobOfOneThatWasKilledAsANewAttempt) {
  const std::string id = post_job(scene_of_13_frames());
  std::unique_ptr<Program> one = start_worker();
  std::unique_ptr<Program> other = start_worker();
  ASSERT_TRUE(has_frames(id, 2));
  Program& at_work = one->runners().empty() ? *other : *one;
  ASSERT_EQ(at_work.runners().size(), 1u);
  EXPECT_EQ(at_work.end(SIGKILL), -SIGKILL);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(job(id).at("attempt"), 2);
  expect_all_frames(id, 13);
}

TEST_F(Workers, ThatFrozePastTheirLeaseChangeNothingWhenTheyThaw) {
  const std::string undisturbed = post_job(scene_of_13_frames());
  std::unique_ptr<Program> frozen = start_worker();
  ASSERT_TRUE(reaches(undisturbed, "succeeded")) << job(undisturbed);
  const std::string id = post_job(scene_of_13_frames());
  ASSERT_TRUE(has_frames(id, 2));
  const std::vector<pid_t> runners = frozen->runners();
  ASSERT_EQ(runners.size(), 1u);
  ASSERT_EQ(::kill(frozen->pid(), SIGSTOP), 0);
  ASSERT_EQ(::kill(runners[0], SIGSTOP), 0);
  const std::unique_ptr<Program> other = start_worker();
  ASSERT_TRUE(eventually([&] { return job(id).at("attempt") == 2; }));
  // The runner thaws first: it draws on, and writes files that nobody asked for.
  ASSERT_EQ(::kill(runners[0], SIGCONT), 0);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  ASSERT_EQ(::kill(frozen->pid(), SIGCONT), 0);
  EXPECT_TRUE(eventually([&] { return frozen->runners().empty(); })) << "it ends what it has lost";
  expect_all_frames(id, 13);
  EXPECT_EQ(frame_hashes(id), frame_hashes(undisturbed));
  EXPECT_EQ(job(id).at("attempt"), 2);
  EXPECT_EQ(state(id), "succeeded");
  EXPECT_TRUE(eventually([&] { return pictures_of(id) == 13; })) << "its late files are swept away";
  EXPECT_TRUE(has_frames(post_job(scene_of_13_frames()), 13)) << "both work on";
}

TEST_F(Workers, HonourACancelOfTheServerWithinTwoSeconds) {
  const std::string id = post_job(long_scene());
  const std::unique_ptr<Program> worker = start_worker();
  ASSERT_TRUE(has_frames(id, 1));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(request(port(), "POST", path(id, "/cancel")).status, 202);
  ASSERT_TRUE(reaches(id, "cancelled"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  EXPECT_TRUE(eventually([&] { return worker->runners().empty(); }));
}

TEST_F(Workers, GiveTheirJobBackOnSigterm) {
  const std::string id = post_job(scene_of_13_frames());
  std::unique_ptr<Program> one = start_worker();
  ASSERT_TRUE(has_frames(id, 1));
  EXPECT_EQ(one->end(SIGTERM), 0);
  EXPECT_EQ(state(id), "queued");
  const std::unique_ptr<Program> other = start_worker();
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(job(id).at("attempt"), 2);
}

TEST_F(Workers, TakeTheStoreFromTheEnvironmentAndKeepItFromTheirRunners) {
  ASSERT_EQ(::setenv("LATHER_STORE", store_.c_str(), 1), 0);
  const Program worker({"worker", "--artifacts", data().string()}, directory_.path() / "worker.log",
                       "working on");
  ASSERT_EQ(::unsetenv("LATHER_STORE"), 0);
  ASSERT_TRUE(has_frames(post_job(long_scene()), 1));
  ASSERT_EQ(worker.runners().size(), 1u);
  EXPECT_NE(environment_of(worker.pid()).find(store_), std::string::npos);
  const std::string given = environment_of(worker.runners()[0]);
  EXPECT_NE(given.find("PATH="), std::string::npos);
  EXPECT_EQ(given.find(store_), std::string::npos);
}

TEST_F(Workers, LostWhileCancellingLeaveACancelledJob) {
  const std::string id = post_job(long_scene());
  const std::unique_ptr<Program> worker = start_worker();
  ASSERT_TRUE(has_frames(id, 1));
  EXPECT_EQ(worker->end(SIGKILL), -SIGKILL);
  EXPECT_EQ(request(port(), "POST", path(id, "/cancel")).status, 202);
  EXPECT_TRUE(reaches(id, "cancelled")) << "the server sees to lost jobs also without workers";
}

}  // namespace
}  // namespace lather::server
