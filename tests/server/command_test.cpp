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

TEST_F(SceneCommand, RunWritesTheFilesThatTheSceneAsksFor) {
  ASSERT_EQ(run("run " + scene_file() + " --threads 1 --set '/output/particles=[\"ply\",\"vdb\"]' --out " +
                out().string()),
            0)
      << said();
  for (const char* name : {"00000.ply", "00003.ply", "00003.vdb"})
    EXPECT_GT(std::filesystem::file_size(out() / "particles" / name), 100U) << name;
  EXPECT_FALSE(std::filesystem::exists(out() / "skin"));
}

/// A ball in space falls on an obstacle that moves; few points, all that a picture can hold.
std::string solid_scene() {
  return R"({"lather": 1, "domain": {"min": [0, 0, 0], "max": [0.4, 0.4, 0.4]}, "duration": 0.04, "frame_rate": 50,
    "spacing": 0.02, "materials": [{"name": "foam", "preset": "shaving-cream"}],
    "bodies": [{"name": "ball", "material": "foam", "velocity": [0, -1, 0],
                "shape": {"type": "sphere", "radius": 0.06, "translate": [0.2, 0.2, 0.2]}}],
    "obstacles": [{"name": "post", "shape": {"type": "box", "size": [0.05, 0.1, 0.05], "translate": [0.2, 0.05, 0.2]},
                   "motion": {"type": "linear", "velocity": [0.5, 0, 0]}}],
    "output": {"width": 160, "height": 120, "particles": ["ply"], "scalars": ["J"]}})";
}

TEST_F(SceneCommand, KeptParticlesDrawnAgainGiveTheSamePictures) {
  std::ofstream(scene_file()) << solid_scene();
  for (const char* look : {"", " --set /look/style=skin", " --set /look/color_by=speed"}) {
    std::filesystem::remove_all(directory_.path() / "again");
    ASSERT_EQ(run("run " + scene_file() + look + " --threads 2 --out " + out().string()), 0) << said();
    // The last frame alone: its camera was framed by the first.
    const std::filesystem::path again = directory_.path() / "again";
    ASSERT_EQ(run("render " + out().string() + " --threads 1 --frames 1:2 --out " + again.string()), 0)
        << said();
    EXPECT_FALSE(std::filesystem::exists(again / "frames" / "00000.png"));
    EXPECT_FALSE(std::filesystem::exists(again / "particles"));
    for (const char* name : {"00001.png", "00002.png"})
      EXPECT_EQ(read(again / "frames" / name), read(out() / "frames" / name)) << name << look;
  }
}

TEST_F(SceneCommand, KeptParticlesAreDrawnWithAnotherLook) {
  std::ofstream(scene_file()) << solid_scene();
  ASSERT_EQ(run("run " + scene_file() + " --out " + out().string()), 0) << said();
  const std::filesystem::path look = directory_.path() / "look.json", again = directory_.path() / "again";
  std::ofstream(look) << R"({"style": "skin", "camera": {"eye": [0.2, 0.3, 1], "target": [0.2, 0.1, 0.2]}})";
  const std::string render = "render " + out().string() + " --out " + again.string();
  ASSERT_EQ(
      run(render + " --look " + look.string() + " --set /output/width=200 --set '/output/skin=[\"obj\"]'"), 0)
      << said();
  EXPECT_EQ(render::decode_png(read(again / "frames" / "00002.png")).width, 200);
  EXPECT_NE(read(again / "skin" / "00002.obj").find("\nf "), std::string::npos);
  ASSERT_EQ(run(render + " --set /look/color_by=J"), 0) << said();
  EXPECT_EQ(run(render + " --set /look/color_by=plastic_strain"), 1);
  EXPECT_NE(said().find("carries"), std::string::npos) << said();
  EXPECT_EQ(run(render + " --set /duration=2"), 2);
  EXPECT_NE(said().find("the look and the output alone"), std::string::npos) << said();
  EXPECT_EQ(run(render + " --frames 9"), 2);
  EXPECT_EQ(run(render + " --frames 2:1"), 2);
}

TEST_F(SceneCommand, SheetShowsFramesOfARunFromFirstToLast) {
  std::ofstream(scene_file()) << solid_scene();
  ASSERT_EQ(run("run " + scene_file() + " --out " + out().string()), 0) << said();
  const std::filesystem::path sheet = directory_.path() / "sheet.png";
  const std::string command = "sheet " + out().string() + " --out " + sheet.string();
  ASSERT_EQ(run(command + " --pictures 3 --width 80"), 0) << said();
  const render::Image image = render::decode_png(read(sheet));
  EXPECT_GT(image.width, 3 * 80);
  EXPECT_LT(image.width, 4 * 80);
  EXPECT_GT(image.height, 60);
  EXPECT_EQ(run(command + " --width 161"), 2);
  EXPECT_NE(said().find("1 to 160"), std::string::npos) << said();
  std::string many = command;
  for (int i = 0; i < 200; ++i) many += " " + out().string();
  EXPECT_EQ(run(many + " --pictures 1 --width 160"), 2);
  EXPECT_NE(said().find("16384 px a side"), std::string::npos) << said();
  EXPECT_EQ(run("sheet " + (directory_.path() / "none").string() + " --out " + sheet.string()), 2);
  EXPECT_NE(said().find("There are no pictures"), std::string::npos) << said();
}

TEST_F(SceneCommand, MeshesLieBesideTheSceneAndNowhereElse) {
  Json scene = Json::parse(solid_scene());
  scene["bodies"][0]["shape"] = {{"type", "mesh"}, {"file", "ball.obj"}, {"translate", {0.2, 0.2, 0.2}}};
  std::ofstream(scene_file()) << scene.dump();
  EXPECT_EQ(run("plan " + scene_file()), 2);
  EXPECT_NE(said().find("There is no readable file"), std::string::npos) << said();
  std::ofstream(directory_.path() / "ball.obj")
      << "v 0.06 0 0\nv -0.06 0 0\nv 0 0.06 0\nv 0 -0.06 0\nv 0 0 0.06\nv 0 0 -0.06\n"
         "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  EXPECT_EQ(run("run " + scene_file() + " --out " + out().string()), 0) << said();
  EXPECT_EQ(run("plan " + scene_file() + " --set /bodies/0/shape/file=../ball.obj"), 2);
  EXPECT_NE(said().find("directory of the scene's file"), std::string::npos) << said();
  EXPECT_EQ(run("plan " + scene_file() + " --set /bodies/0/shape/file=/etc/passwd"), 2);
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
