// What the page is made of, as the server gives it: its files, and the example scenes with their pictures.

#include <filesystem>
#include <fstream>

#include "render/render.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

class Page : public Blackbox {
 protected:
  /// A folder of example scenes: one whole, one broken, one with a picture.
  std::filesystem::path scenes() {
    std::filesystem::path folder = directory_.path() / "scenes";
    std::filesystem::create_directories(folder / "pictures");
    std::ofstream(folder / "broken.json") << "{";
    std::ofstream(folder / "plain.json") << "{\"lather\": 1}";
    std::ofstream(folder / "seen.json") << small_scene();
    std::ofstream(folder / "pictures" / "seen.jpg") << "a picture";
    std::ofstream(directory_.path() / "secret.jpg") << "no picture";
    return folder;
  }
};

TEST_F(Page, EachFileIsSentOnceToWhoKeepsIt) {
  start();
  for (const char* name :
       {"/", "/app.js", "/app.css", "/editor.js", "/orbit3d.js", "/icon.svg", "/licenses.txt"}) {
    const RawResponse first = request(port(), "GET", name);
    ASSERT_EQ(first.status, 200) << name;
    const RawResponse again =
        request(port(), "GET", name, {}, "If-None-Match: " + first.headers.at("etag") + "\r\n");
    EXPECT_EQ(again.status, 304) << name;
    EXPECT_EQ(again.body, "");
    EXPECT_EQ(again.headers.at("etag"), first.headers.at("etag"));
  }
}

TEST_F(Page, ScenesAreListedWithWhatTheySayAndTheirPictures) {
  start({"--scenes", scenes().string()});
  const Json list = Json::parse(request(port(), "GET", "/api/v1/scenes").body).at("scenes");
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0].at("name"), "broken");
  EXPECT_TRUE(list[0].at("title").is_null());
  EXPECT_EQ(list[1].at("name"), "plain");
  EXPECT_TRUE(list[1].at("title").is_null());
  EXPECT_TRUE(list[1].at("picture").is_null());
  EXPECT_EQ(list[2].at("title"), "a small blob");
  EXPECT_EQ(list[2].at("dimension"), 2);
  const RawResponse picture = request(port(), "GET", list[2].at("picture"));
  EXPECT_EQ(picture.status, 200);
  EXPECT_EQ(picture.headers.at("content-type"), "image/jpeg");
  EXPECT_EQ(picture.body, "a picture");
  const std::string tag = "If-None-Match: " + picture.headers.at("etag") + "\r\n";
  EXPECT_EQ(request(port(), "GET", list[2].at("picture"), {}, tag).status, 304);
  EXPECT_EQ(request(port(), "GET", "/api/v1/scenes/plain.jpg").status, 404);
  EXPECT_EQ(request(port(), "GET", "/api/v1/scenes/..%2f..%2fsecret.jpg").status, 404);
}

TEST_F(Page, APictureHoldsTheSceneThatItShows) {
  start();
  const std::string id = post_job(small_scene());
  ASSERT_TRUE(has_frames(id, 1));
  std::string kept;
  for (const auto& [keyword, text] : render::png_text(request(port(), "GET", path(id, "/frames/0.png")).body))
    if (keyword == "lather:scene-json") kept = text;
  ASSERT_FALSE(kept.empty());
  EXPECT_EQ(Json::parse(kept), Json::parse(request(port(), "GET", path(id, "/plan")).body).at("scene"));
}

}  // namespace
}  // namespace lather::server
