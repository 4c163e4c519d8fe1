#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/server/eventually.h"
#include "tests/server/raw_http.h"
#include "tests/server/server_process.h"
#include "tests/server/temporary_directory.h"

namespace lather::server {

/// A server with a data directory of its own, and the words that tests use with it.
class Blackbox : public ::testing::Test {
 protected:
  using Json = nlohmann::json;

  void start(std::vector<std::string> further_arguments = {}) {
    server_.reset();
    server_ = std::make_unique<ServerProcess>(data(), std::move(further_arguments));
  }
  [[nodiscard]] std::filesystem::path data() const { return directory_.path() / "data"; }
  [[nodiscard]] int port() const { return server_->port(); }

  /// A blob falls for four frames of 160 x 120; a few hundred points.
  static Json small_scene() { return scene(0.1); }
  /// The same for hours.
  static Json long_scene() { return scene(300); }

  std::string post_job(const Json& body) {
    const RawResponse response = request(port(), "POST", "/api/v1/jobs", body.dump());
    EXPECT_EQ(response.status, 201) << response.body;
    return response.status == 201 ? Json::parse(response.body).at("id").get<std::string>() : std::string();
  }
  Json job(const std::string& id) { return Json::parse(request(port(), "GET", path(id)).body); }
  std::string state(const std::string& id) { return job(id).value("state", ""); }
  bool reaches(const std::string& id, const std::string& wanted) {
    return eventually([&] { return state(id) == wanted; });
  }
  bool has_frames(const std::string& id, int count) {
    return eventually([&] { return job(id).value("frames", 0) >= count; });
  }
  static std::string path(const std::string& id, const std::string& rest = {}) {
    return "/api/v1/jobs/" + id + rest;
  }

  /// SHA-256 of the job's frames, as the server lists them.
  std::vector<std::string> frame_hashes(const std::string& id) {
    std::vector<std::string> hashes;
    const Json listing = Json::parse(request(port(), "GET", path(id, "/frames")).body);
    for (const Json& row : listing.at("frames")) hashes.push_back(row.at("sha256"));
    return hashes;
  }

  TemporaryDirectory directory_;
  std::unique_ptr<ServerProcess> server_;

  static Json scene(double duration) {
    return {{"lather", 1},
            {"name", "a small blob"},
            {"dimension", 2},
            {"domain", {{"min", {-0.16, 0}}, {"max", {0.16, 0.32}}}},
            {"gravity", {0, -9.81}},
            {"duration", duration},
            {"frame_rate", 30},
            {"spacing", 0.01},
            {"materials", {{{"name", "foam"}, {"preset", "shaving-cream"}}}},
            {"bodies",
             {{{"name", "blob"},
               {"material", "foam"},
               {"shape", {{"type", "sphere"}, {"radius", 0.05}, {"translate", {0.0, 0.2}}}}}}},
            {"output", {{"width", 160}, {"height", 120}}}};
  }
};

}  // namespace lather::server
