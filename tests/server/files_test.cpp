// Particles and skins over HTTP, and jobs that draw kept particles again.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "render/render.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

class Files : public Blackbox {
 protected:
  static Json keeping_scene() {
    Json scene = small_scene();
    scene["output"]["particles"] = {"ply"};
    return scene;
  }
  std::string finished_job(const Json& scene) {
    std::string id = post_job(scene);
    EXPECT_TRUE(reaches(id, "succeeded")) << job(id).dump();
    return id;
  }
  RawResponse get(const std::string& id, const std::string& rest) {
    return request(port(), "GET", path(id, rest));
  }
  RawResponse post(const std::string& id, const Json& body) {
    return request(port(), "POST", path(id, "/render"), body.dump());
  }
};

TEST_F(Files, ParticlesAreDownloadedWhole) {
  start();
  const std::string id = finished_job(keeping_scene());
  const RawResponse ply = get(id, "/particles/3.ply");
  ASSERT_EQ(ply.status, 200);
  EXPECT_EQ(ply.body.substr(0, 4), "ply\n");
  const std::string end = "end_header\n";
  const auto points = job(id).at("points").get<std::size_t>();
  EXPECT_EQ(ply.body.size(), ply.body.find(end) + end.size() + points * 29);  // floats, id and material
}

TEST_F(Files, WhatIsNotThereIsNotFoundAndSaysHowToGetIt) {
  start();
  const std::string id = finished_job(keeping_scene());
  const RawResponse skin = get(id, "/skin/0.obj");
  EXPECT_EQ(skin.status, 404);
  EXPECT_NE(skin.body.find("\\\"skin\\\": [\\\"obj\\\"]"), std::string::npos) << skin.body;
  EXPECT_EQ(get(id, "/particles/4.ply").status, 404);
  EXPECT_EQ(get(id, "/particles/..%2f..%2freport.ply").status, 404);
  EXPECT_EQ(get(id, "/particles/0.txt").status, 404);
}

TEST_F(Files, SkinsOfAJobAreDownloaded) {
  start();
  Json scene = small_scene();
  scene["dimension"] = 3;
  scene["domain"] = {{"min", {-0.16, 0, -0.16}}, {"max", {0.16, 0.32, 0.16}}};
  scene["gravity"] = {0, -9.81, 0};
  scene["duration"] = 0.04;
  scene["spacing"] = 0.02;
  scene["bodies"][0]["shape"]["translate"] = {0, 0.2, 0};
  scene["output"]["skin"] = {"obj", "vdb"};
  const std::string id = finished_job(scene);
  const RawResponse obj = get(id, "/skin/1.obj");
  ASSERT_EQ(obj.status, 200) << obj.body;
  EXPECT_NE(obj.body.find("\nf "), std::string::npos);
  EXPECT_EQ(get(id, "/skin/1.vdb").status, 200);
  EXPECT_TRUE(Json::parse(get(id, "/report").body).at("frames").at(1).contains("skin_volume"));
}

TEST_F(Files, AJobDrawsAnothersParticlesAgain) {
  start();
  const std::string id = finished_job(keeping_scene());
  const RawResponse posted = post(id, Json::object());
  ASSERT_EQ(posted.status, 201) << posted.body;
  const std::string same = Json::parse(posted.body).at("id");
  ASSERT_TRUE(reaches(same, "succeeded")) << job(same).dump();
  for (const char* frame : {"/frames/0.png", "/frames/3.png"})
    EXPECT_EQ(get(same, frame).body, get(id, frame).body) << frame;
  // … with another look, and from a job that drew again itself.
  const RawResponse other = post(same, {{"set", {{"/look/color_by", "speed"}, {"/output/width", 200}}}});
  ASSERT_EQ(other.status, 201) << other.body;
  const std::string wide = Json::parse(other.body).at("id");
  ASSERT_TRUE(reaches(wide, "succeeded")) << job(wide).dump();
  EXPECT_EQ(render::decode_png(get(wide, "/frames/3.png").body).width, 200);
}

TEST_F(Files, DrawingAgainIsRefusedWithAReason) {
  start();
  const std::string bare = finished_job(small_scene());
  const RawResponse none = post(bare, Json::object());
  EXPECT_EQ(none.status, 409);
  EXPECT_NE(none.body.find("keeps no particles"), std::string::npos) << none.body;
  const std::string id = finished_job(keeping_scene());
  EXPECT_EQ(post(id, {{"set", {{"/duration", 2}}}}).status, 422);
  EXPECT_EQ(post(id, {{"look", {{"style", "fur"}}}}).status, 422);
  EXPECT_EQ(post(id, {{"set", {{"/output/width", 16000}, {"/output/height", 16000}}}}).status, 422);
  EXPECT_EQ(post(id, {{"set", {{"/output/skin", {"obj"}}}}}).status, 422);
  EXPECT_EQ(post(id, {{"scene", 1}}).status, 422);
  const std::string running = post_job(long_scene());
  EXPECT_EQ(post(running, Json::object()).status, 409);
}

TEST_F(Files, AFilmHasEveryFrameWhereThereIsFfmpeg) {
  start();
  Json scene = small_scene();
  scene["output"]["width"] = 161;  // codecs want even sizes
  const std::string id = finished_job(scene);
  EXPECT_EQ(get(id, "/film.mp4?fps=0").status, 400);
  EXPECT_EQ(get(id, "/film.mp4?speed=2").status, 400);
  if (std::system("command -v ffprobe >/dev/null") != 0) GTEST_SKIP() << "not tried: there is no ffmpeg here";
  for (const std::string ending : {"mp4", "webm"}) {
    const RawResponse film = get(id, "/film." + ending);
    ASSERT_EQ(film.status, 200) << film.body;
    EXPECT_EQ(film.headers.at("content-type"), "video/" + ending);
    EXPECT_EQ(film.headers.at("content-disposition"), "attachment; filename=\"" + id + '.' + ending + '"');
    const std::filesystem::path file = directory_.path() / ("film." + ending);
    const std::filesystem::path facts = directory_.path() / "facts";
    std::ofstream(file, std::ios::binary) << film.body;
    const std::string probe =
        "ffprobe -v error -count_frames -show_entries stream=width,height,r_frame_rate,nb_read_frames -of "
        "csv=p=0 '" +
        file.string() + "' > '" + facts.string() + "'";
    ASSERT_EQ(std::system(probe.c_str()), 0);
    std::ifstream lines(facts);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "162,120,30/1,4") << ending;
  }
}

TEST_F(Files, AServerWithoutFfmpegSaysSo) {
  start({"--workers", "0", "--ffmpeg", "/nonexistent/ffmpeg"});
  const RawResponse film = get(post_job(small_scene()), "/film.mp4");
  EXPECT_EQ(film.status, 501);
  EXPECT_NE(film.body.find("install ffmpeg"), std::string::npos) << film.body;
}

TEST_F(Files, AnEncoderThatFailsCutsTheFilmOff) {
  start({"--ffmpeg", "/bin/false"});
  const std::string id = finished_job(small_scene());
  EXPECT_THROW(static_cast<void>(get(id, "/film.webm")), std::runtime_error) << "a body without an end";
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(Files, AMeshByItsPathIsRefused) {
  start();
  Json scene = small_scene();
  scene["bodies"][0]["shape"] = {{"type", "mesh"}, {"file", "/etc/passwd"}};
  const RawResponse refused = request(port(), "POST", "/api/v1/jobs", scene.dump());
  EXPECT_EQ(refused.status, 422);
  EXPECT_NE(refused.body.find("/bodies/0/shape/file"), std::string::npos) << refused.body;
  EXPECT_NE(refused.body.find("by upload"), std::string::npos) << refused.body;
}

}  // namespace
}  // namespace lather::server
