#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "render/render.h"
#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

constexpr int kFrames = 4;

std::map<std::string, std::string> unzip(const std::string& zip) {
  std::map<std::string, std::string> files;
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(), archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());
  if (archive_read_open_memory(reader.get(), zip.data(), zip.size()) != ARCHIVE_OK) return files;
  archive_entry* entry = nullptr;
  while (archive_read_next_header(reader.get(), &entry) == ARCHIVE_OK) {
    std::string bytes(static_cast<std::size_t>(archive_entry_size(entry)), '\0');
    if (archive_read_data(reader.get(), bytes.data(), bytes.size()) == static_cast<la_ssize_t>(bytes.size()))
      files[archive_entry_pathname(entry)] = bytes;
  }
  return files;
}

bool is_blank(const render::Image& image) {
  for (std::size_t i = 3; i < image.rgb.size(); ++i)
    if (image.rgb[i] != image.rgb[i % 3]) return false;
  return true;
}

class JobLife : public Blackbox {
 protected:
  std::string frame(const std::string& id, int index) {
    const RawResponse response =
        request(port(), "GET", path(id, "/frames/" + std::to_string(index) + ".png"));
    EXPECT_EQ(response.status, 200) << response.body;
    return response.body;
  }
};

TEST_F(JobLife, APostedSceneBecomesPicturesThatCanBeDownloaded) {
  start();
  const std::string id = post_job(small_scene());
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  std::vector<render::Image> images;
  std::vector<std::string> files;
  for (int index = 0; index < kFrames; ++index) {
    files.push_back(frame(id, index));
    images.push_back(render::decode_png(files.back()));
    EXPECT_EQ(images.back().width, 160);
    EXPECT_EQ(images.back().height, 120);
    EXPECT_FALSE(is_blank(images.back())) << index;
  }
  EXPECT_NE(images.front().rgb, images.back().rgb);
  EXPECT_EQ(request(port(), "GET", path(id, "/frames/4.png")).status, 404);

  const std::map<std::string, std::string> zipped =
      unzip(request(port(), "GET", path(id, "/frames.zip")).body);
  ASSERT_EQ(zipped.size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(zipped.at("00000.png"), files[0]);
  EXPECT_EQ(zipped.at("00003.png"), files[3]);

  const Json last = job(id);
  EXPECT_EQ(last.at("frames"), kFrames);
  EXPECT_EQ(last.at("progress").at("fraction"), 1);
  EXPECT_TRUE(last.at("error").is_null());
  const Json report = Json::parse(request(port(), "GET", path(id, "/report")).body);
  EXPECT_EQ(report.at("state"), "succeeded");
  EXPECT_EQ(request(port(), "GET", path(id, "/plan")).status, 200);
  EXPECT_EQ(request(port(), "GET", path(id, "/log")).status, 200);
}

TEST_F(JobLife, ProbesAreServedAsCsvAndAreMissingWithoutProbes) {
  start();
  Json scene = small_scene();
  scene["probes"] = Json::parse(R"([{"type": "walls", "name": "box"}])");
  const std::string id = post_job(scene);
  ASSERT_TRUE(reaches(id, "succeeded")) << job(id);
  EXPECT_EQ(job(id).at("links").at("probes"), path(id, "/probes.csv"));
  const RawResponse csv = request(port(), "GET", path(id, "/probes.csv"));
  EXPECT_EQ(csv.status, 200);
  EXPECT_EQ(csv.headers.at("content-type"), "text/csv; charset=utf-8");
  EXPECT_EQ(csv.body.rfind("probe,quantity,unit,time,value\nbox,force_x,N,", 0), 0U) << csv.body;
  // A line of names, then six quantities at each frame but the first.
  EXPECT_EQ(std::count(csv.body.begin(), csv.body.end(), '\n'), 1 + 6 * (kFrames - 1));
  const Json report = Json::parse(request(port(), "GET", path(id, "/report")).body);
  EXPECT_EQ(report.at("probes").at(0).at("samples").size(), static_cast<std::size_t>(kFrames - 1));

  const std::string plain = post_job(small_scene());
  ASSERT_TRUE(reaches(plain, "succeeded")) << job(plain);
  EXPECT_EQ(request(port(), "GET", path(plain, "/probes.csv")).status, 404);
}

TEST_F(JobLife, AFrameHasAnETagAndServesOneRange) {
  start();
  const std::string id = post_job(small_scene());
  ASSERT_TRUE(has_frames(id, 1));
  const std::string target = path(id, "/frames/0.png");
  const RawResponse whole = request(port(), "GET", target);
  EXPECT_EQ(whole.headers.at("content-type"), "image/png");
  EXPECT_EQ(whole.headers.at("x-content-type-options"), "nosniff");
  EXPECT_EQ(whole.headers.at("etag"), '"' + frame_hashes(id)[0] + '"');
  EXPECT_EQ(request(port(), "GET", target, "", "If-None-Match: " + whole.headers.at("etag") + "\r\n").status,
            304);
  const RawResponse part = request(port(), "GET", target, "", "Range: bytes=1-3\r\n");
  EXPECT_EQ(part.status, 206);
  EXPECT_EQ(part.body, "PNG");
  EXPECT_EQ(part.headers.at("content-range"), "bytes 1-3/" + std::to_string(whole.body.size()));
  EXPECT_EQ(request(port(), "GET", target, "", "Range: bytes=99999999-\r\n").status, 416);
  EXPECT_EQ(request(port(), "GET", target, "", "Range: bytes=0-1,3-4\r\n").status, 416);
  const RawResponse head = request(port(), "HEAD", target);
  EXPECT_EQ(head.status, 200);
  EXPECT_TRUE(head.body.empty());
}

TEST_F(JobLife, ACancelledJobIsOverWithinTwoSeconds) {
  start();
  const std::string running = post_job(long_scene());
  const std::string queued = post_job(long_scene());
  ASSERT_TRUE(has_frames(running, 1));
  EXPECT_EQ(request(port(), "POST", path(queued, "/cancel")).status, 202);
  EXPECT_EQ(state(queued), "cancelled");
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(request(port(), "POST", path(running, "/cancel")).status, 202);
  ASSERT_TRUE(reaches(running, "cancelled"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  EXPECT_EQ(request(port(), "POST", path(running, "/cancel")).status, 409);
  EXPECT_GE(job(running).at("frames"), 1) << "frames made before stay";
}

TEST_F(JobLife, AnEndedJobCanBeDeletedAndARunningOneCannot) {
  start();
  const std::string id = post_job(long_scene());
  ASSERT_TRUE(has_frames(id, 1));
  EXPECT_EQ(request(port(), "DELETE", path(id)).status, 409);
  EXPECT_EQ(request(port(), "POST", path(id, "/cancel")).status, 202);
  ASSERT_TRUE(reaches(id, "cancelled"));
  EXPECT_EQ(request(port(), "DELETE", path(id)).status, 204);
  EXPECT_EQ(request(port(), "GET", path(id)).status, 404);
  EXPECT_FALSE(std::filesystem::exists(data() / "jobs" / id));
}

TEST_F(JobLife, AKilledServerLosesNoFinishedFrameAndNoQueuedJob) {
  start();
  const std::string finished = post_job(small_scene());
  ASSERT_TRUE(reaches(finished, "succeeded"));
  const std::vector<std::string> hashes = frame_hashes(finished);
  Json scene = small_scene();
  scene["duration"] = 0.4;
  const std::string running = post_job(scene);
  const std::string queued = post_job(small_scene());
  ASSERT_TRUE(has_frames(running, 2));
  const std::vector<pid_t> runners = server_->runners();
  EXPECT_EQ(server_->end(SIGKILL), -SIGKILL);
  EXPECT_TRUE(eventually([&] {
    return std::none_of(runners.begin(), runners.end(), [](pid_t pid) { return ::kill(pid, 0) == 0; });
  })) << "a runner ends with its server";
  std::ofstream(data() / "jobs" / finished / "half.png.part") << "half";

  start({"--workers", "0"});
  EXPECT_EQ(frame_hashes(finished), hashes);
  EXPECT_EQ(render::decode_png(frame(running, 1)).width, 160) << "published before the crash";
  EXPECT_EQ(state(running), "queued");
  EXPECT_EQ(state(queued), "queued");
  EXPECT_FALSE(std::filesystem::exists(data() / "jobs" / finished / "half.png.part"));

  start();
  EXPECT_TRUE(reaches(running, "succeeded")) << job(running);
  EXPECT_TRUE(reaches(queued, "succeeded")) << job(queued);
  EXPECT_EQ(job(running).at("attempt"), 2);
  EXPECT_EQ(job(running).at("frames"), 13);
  EXPECT_EQ(frame_hashes(queued), hashes) << "the same scene gives the same bytes";
}

TEST_F(JobLife, ASecondServerOnTheSameDataIsRefused) {
  start();
  try {
    const ServerProcess second(data());
    FAIL() << "a second server started";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("another server uses the data directory"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(JobLife, ARunawaySimulationFailsWithAdviceAndKeepsItsFrames) {
  start();
  Json scene = small_scene();
  scene["numerics"] = {{"time_step", 0.01}};  // a hundred times the bound
  const std::string id = post_job(scene);
  ASSERT_TRUE(reaches(id, "failed")) << job(id);
  EXPECT_FALSE(job(id).at("error").get<std::string>().empty());
  EXPECT_GE(job(id).at("frames"), 1);
}

}  // namespace
}  // namespace lather::server
