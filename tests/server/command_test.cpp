#include "tests/server/command.h"

#include "render/render.h"

namespace lather::server {
namespace {

class SceneCommand : public Command {
 protected:
  void SetUp() override { std::ofstream(scene_file()) << small_scene().dump(); }

  [[nodiscard]] std::string scene_file() const { return (directory_.path() / "scene.json").string(); }
  [[nodiscard]] std::filesystem::path out() const { return directory_.path() / "out"; }
};

TEST_F(SceneCommand, RunWritesFramesReportAndPlan) {
  ASSERT_EQ(run("run " + scene_file() + " --threads 1 --out " + out().string()), 0) << said();
  for (const char* name : {"00000.png", "00003.png"})
    EXPECT_EQ(render::decode_png(read(out() / "frames" / name)).width, 160) << name;
  EXPECT_FALSE(std::filesystem::exists(out() / "frames" / "00004.png"));
  EXPECT_EQ(Json::parse(read(out() / "report.json")).at("state"), "succeeded");
  EXPECT_EQ(Json::parse(read(out() / "plan.json")).at("frames"), 4);
}

TEST_F(SceneCommand, RunWritesProbesAsCsv) {
  const std::string probes = R"('/probes=[{"type": "walls", "name": "box"}]')";
  ASSERT_EQ(run("run " + scene_file() + " --threads 1 --out " + out().string() + " --set " + probes), 0)
      << said();
  EXPECT_EQ(read(out() / "probes.csv").rfind("probe,quantity,unit,time,value\nbox,force_x,N,", 0), 0U);
}

TEST_F(SceneCommand, BadInputEndsWithTwoAndNamesThePlace) {
  EXPECT_EQ(run("run " + scene_file() + " --set /spacing=-1 --out " + out().string()), 2);
  EXPECT_NE(said().find("/spacing"), std::string::npos) << said();
  EXPECT_EQ(run("plan " + scene_file() + " --set nonsense"), 2);
  EXPECT_EQ(run("plan " + (directory_.path() / "missing.json").string()), 2);
  EXPECT_EQ(run("run " + scene_file() + " --render-backend crayon --out " + out().string()), 2);
  EXPECT_EQ(run("unknown"), 2);
}

TEST_F(SceneCommand, AWorkerNeedsAPostgresqlStoreAndTheServersArtifacts) {
  std::filesystem::create_directories(out() / "jobs");
  EXPECT_EQ(run("worker --store sqlite:secret --artifacts " + out().string()), 2);
  EXPECT_NE(said().find("postgresql://"), std::string::npos) << said();
  EXPECT_EQ(said().find("secret"), std::string::npos) << said();
  EXPECT_EQ(run("worker --store postgresql:///none --artifacts " + directory_.path().string()), 2);
  EXPECT_NE(said().find("lather serve"), std::string::npos) << said();
  EXPECT_EQ(run("serve --port 0 --artifacts " + out().string() + " --data " + data().string()), 2);
  EXPECT_NE(said().find("--store"), std::string::npos) << said();
}

TEST_F(SceneCommand, ARunawaySimulationEndsWithThreeAndKeepsItsFrames) {
  EXPECT_EQ(run("run " + scene_file() + " --set /numerics/time_step=0.01 --out " + out().string()), 3)
      << said();
  EXPECT_EQ(render::decode_png(read(out() / "frames" / "00000.png")).width, 160);
  EXPECT_EQ(Json::parse(read(out() / "report.json")).at("state"), "failed");
}

TEST_F(SceneCommand, PlanPrintsNumbersForPeopleAndPrograms) {
  ASSERT_EQ(run("plan " + scene_file() + " --json"), 0);
  EXPECT_GT(Json::parse(said()).at("points"), 0);
  ASSERT_EQ(run("plan " + scene_file()), 0);
  EXPECT_NE(said().find("points"), std::string::npos);
}

TEST_F(SceneCommand, SubmitDownloadsWhatTheServerMade) {
  start();
  const std::string server = " --server http://127.0.0.1:" + std::to_string(port());
  ASSERT_EQ(run("submit " + scene_file() + server + " --out " + out().string()), 0) << said();
  EXPECT_EQ(render::decode_png(read(out() / "frames" / "00003.png")).height, 120);
  EXPECT_EQ(Json::parse(read(out() / "report.json")).at("state"), "succeeded");
  EXPECT_EQ(run("submit " + scene_file() + server + " --set /spacing=-1"), 2);
  EXPECT_NE(said().find("/spacing"), std::string::npos) << said();
}

}  // namespace
}  // namespace lather::server
