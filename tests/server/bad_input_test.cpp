#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

/// One server without workers for all: nothing here needs a job to run.
class BadInput : public Blackbox {
 protected:
  void SetUp() override { start({"--workers", "0", "--max-points", "5000", "--request-seconds", "1"}); }

  Json problem(const RawResponse& response, int status) {
    EXPECT_EQ(response.status, status) << response.body;
    EXPECT_EQ(response.headers.at("content-type"), "application/problem+json");
    Json document = Json::parse(response.body);
    EXPECT_EQ(document.at("status"), status);
    return document;
  }
  RawResponse post(const std::string& body, const std::string& headers = {}) {
    return request(port(), "POST", "/api/v1/jobs", body, headers);
  }
  int status(const std::string& bytes) { return exchange(port(), bytes).status; }
};

TEST_F(BadInput, AnInvalidSceneIsAnsweredWithPointerValueAndWhatIsAllowed) {
  Json scene = small_scene();
  scene["spacing"] = -1;
  for (const bool enveloped : {false, true}) {
    const Json body = enveloped ? Json{{"scene", scene}} : scene;
    const Json document = problem(post(body.dump()), 422);
    const Json error = document.at("errors").at(0);
    EXPECT_EQ(error.at("pointer"), enveloped ? "/scene/spacing" : "/spacing");
    EXPECT_EQ(error.at("value"), "-1");
    EXPECT_FALSE(error.at("allowed").get<std::string>().empty());
    EXPECT_FALSE(error.at("message").get<std::string>().empty());
  }
}

TEST_F(BadInput, UnknownMembersAndSizesAreRefused) {
  Json scene = small_scene();
  scene["spacin"] = 1;
  EXPECT_EQ(problem(post(scene.dump()), 422).at("errors").at(0).at("pointer"), "/spacin");
  EXPECT_EQ(problem(post(Json{{"scene", small_scene()}, {"sise", "preview"}}.dump()), 422)
                .at("errors")
                .at(0)
                .at("pointer"),
            "/sise");
  problem(post(Json{{"scene", small_scene()}, {"size", "giant"}}.dump()), 422);
  problem(post(Json{{"scene", small_scene()}, {"priority", 2.5}}.dump()), 422);
  problem(post("[]"), 422);
  problem(post("{}"), 422);
}

TEST_F(BadInput, ABodyThatIsNoPlainJsonIsRefused) {
  problem(post("{\"lather\": 1,"), 400);
  problem(post("{\"lather\": 1, \"lather\": 2}"), 400);
  problem(post("{\"lather\": 1, \"spacing\": 1e999}"), 400);
  problem(post(std::string(100000, '[') + std::string(100000, ']')), 400);
  problem(post(small_scene().dump(), "Content-Type: text/plain\r\n"), 415);
  problem(request(port(), "POST", "/api/v1/jobs"), 415);
}

TEST_F(BadInput, ATooLargeJobIsRefusedWithItsPlan) {
  Json scene = small_scene();
  scene["spacing"] = 0.001;
  const Json document = problem(post(scene.dump()), 422);
  EXPECT_EQ(document.at("errors").at(0).at("pointer"), "/spacing");
  EXPECT_GT(document.at("plan").at("points"), 5000);
  EXPECT_EQ(request(port(), "GET", "/api/v1/jobs").body.find("a small blob"), std::string::npos);
}

TEST_F(BadInput, OverridesAndSizesOfAnEnvelopeAreApplied) {
  Json scene = small_scene();
  scene["sizes"] = {{"tiny", {{"duration", 0.2}}}};
  const RawResponse plan =
      request(port(), "POST", "/api/v1/plan",
              Json{{"scene", scene}, {"size", "tiny"}, {"set", {{"/frame_rate", 60}, {"/output/width", 320}}}}
                  .dump());
  ASSERT_EQ(plan.status, 200) << plan.body;
  const Json document = Json::parse(plan.body);
  EXPECT_EQ(document.at("frames"), 13);
  EXPECT_EQ(document.at("scene").at("output").at("width"), 320);
}

TEST_F(BadInput, UnknownThingsAreMissingAndOtherMethodsRefused) {
  const std::string unknown = "AAAAAAAAAAAAAAAAAAAAAA";
  for (const char* rest : {"", "/frames", "/frames/0.png", "/frames.zip", "/report", "/plan", "/log"})
    problem(request(port(), "GET", path(unknown, rest)), 404);
  problem(request(port(), "POST", path(unknown, "/cancel")), 404);
  problem(request(port(), "DELETE", path(unknown)), 404);
  problem(request(port(), "GET", path("..%2f..%2fetc%2fpasswd")), 404);
  problem(request(port(), "GET", "/api/v1/nothing"), 404);
  problem(request(port(), "GET", "/api/v1/scenes/..%2flather.db"), 404);
  const RawResponse refused = request(port(), "DELETE", "/api/v1/jobs");
  problem(refused, 405);
  EXPECT_EQ(refused.headers.at("allow"), "GET, HEAD, POST");
}

TEST_F(BadInput, QueryParametersAreChecked) {
  for (const char* query :
       {"limit=0", "limit=201", "limit=x", "cursor=x", "state=lost", "page=2", "limit=1&limit=2"})
    problem(request(port(), "GET", std::string("/api/v1/jobs?") + query), 400);
}

TEST_F(BadInput, BytesThatBreakTheRulesAreRefusedAndTheServerGoesOn) {
  const std::string host = "Host: localhost\r\n";
  const std::string target = "POST /api/v1/jobs HTTP/1.1\r\n" + host;
  EXPECT_EQ(status(target + "Transfer-Encoding: chunked\r\n\r\n5\r\nhello\r\n0\r\n\r\n"), 411);
  EXPECT_EQ(status(target + "Transfer-Encoding: chunked\r\n\r\n-2\r\nhello"), 411);
  EXPECT_EQ(status(target + "Content-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n"), 400);
  EXPECT_EQ(status(target + "Content-Length: 5\r\nContent-Length: 6\r\n\r\nhello"), 400);
  EXPECT_EQ(status(target + "\r\n"), 411);
  EXPECT_EQ(status(target + "Content-Length: 1000000000\r\n\r\n"), 413);
  EXPECT_EQ(status(target + "Content-Encoding: gzip\r\nContent-Length: 2\r\n\r\n{}"), 415);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + "Content-Length: 5\r\n\r\nhello"), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + "X: a%0d%0ab\r\n\r\n"), 400);
  EXPECT_EQ(status("GET /" + std::string(4096, 'a') + " HTTP/1.1\r\n" + host + "\r\n"), 414);
  EXPECT_EQ(status("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"), 403);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + "Origin: null\r\nConnection: close\r\n\r\n"), 403);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n" + host + "X: " + std::string(64 << 10, 'a') + "\r\n\r\n"), 431);
  EXPECT_EQ(status("\x16\x03\x01\x02 TLS hello\r\n\r\n"), 400);
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
}

TEST_F(BadInput, FloodsOfBytesDoNotFillTheMemory) {
  const auto peak_kib = [this] {
    std::ifstream status_file("/proc/" + std::to_string(server_->pid()) + "/status");
    for (std::string line; std::getline(status_file, line);)
      if (line.compare(0, 6, "VmHWM:") == 0) return std::stol(line.substr(6));
    return -1L;
  };
  const long before = peak_kib();
  ASSERT_GT(before, 0);
  const std::string start_line = "POST /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\n";
  const std::string flood(std::size_t{64} << 20, 'a');
  EXPECT_EQ(status(start_line + "X: " + flood + "\r\n\r\n"), 431);
  EXPECT_EQ(status(start_line + "Transfer-Encoding: chunked\r\n\r\n4000000\r\n" + flood), 411);
  EXPECT_EQ(status(start_line + "Content-Length: 67108864\r\n\r\n" + flood), 413);
  EXPECT_LT(peak_kib() - before, 16 << 10);
}

TEST_F(BadInput, ARefusedRequestTakesWhatFollowsItWithIt) {
  const std::string smuggled = "DELETE /api/v1/jobs HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const RawResponse response =
      exchange(port(), "GET /healthz HTTP/1.1\r\nHost: localhost\r\nContent-Length: " +
                           std::to_string(smuggled.size()) + "\r\n\r\n" + smuggled);
  EXPECT_EQ(response.status, 400);
  EXPECT_EQ(response.body.find("HTTP/1.1"), std::string::npos) << "a second answer came";
}

TEST_F(BadInput, SlowClientsDelayNobodyAndAreSentAway) {
  std::vector<int> slow;
  for (int i = 0; i < 200; ++i) {
    slow.push_back(connect_to(port()));
    ASSERT_EQ(::send(slow.back(), "GET / HT", 8, MSG_NOSIGNAL), 8);
  }
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(900));
  char answer[16] = {};
  EXPECT_EQ(::recv(slow[0], answer, 12, MSG_WAITALL), 12);
  EXPECT_EQ(std::string(answer), "HTTP/1.1 408");
  for (const int fd : slow) ::close(fd);
}

TEST_F(BadInput, TheSameIdempotencyKeyMakesOneJobAndRefusesAnother) {
  const std::string key = "Idempotency-Key: once\r\n";
  const RawResponse first = post(small_scene().dump(), key);
  EXPECT_EQ(first.status, 201);
  const std::string id = Json::parse(first.body).at("id");
  EXPECT_EQ(first.headers.at("location"), path(id));
  const RawResponse again = post(small_scene().dump(), key);
  EXPECT_EQ(again.status, 200);
  EXPECT_EQ(Json::parse(again.body).at("id"), id);
  problem(post(long_scene().dump(), key), 422);
  EXPECT_EQ(Json::parse(request(port(), "GET", "/api/v1/jobs").body).at("jobs").size(), 1u);
}

TEST_F(BadInput, JobsAreListedInPages) {
  for (int i = 0; i < 3; ++i) post_job(small_scene());
  const Json first = Json::parse(request(port(), "GET", "/api/v1/jobs?limit=2&state=queued").body);
  EXPECT_EQ(first.at("jobs").size(), 2u);
  const std::string cursor = first.at("next_cursor");
  const Json second = Json::parse(request(port(), "GET", "/api/v1/jobs?limit=2&cursor=" + cursor).body);
  EXPECT_EQ(second.at("jobs").size(), 1u);
  EXPECT_TRUE(second.at("next_cursor").is_null());
}

TEST_F(BadInput, ThePageIsServedWithAPolicyThatLetsNoForeignScriptRun) {
  const RawResponse page = request(port(), "GET", "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
  EXPECT_NE(page.headers.at("content-security-policy").find("script-src 'self'"), std::string::npos);
  EXPECT_EQ(request(port(), "GET", "/app.js").headers.at("content-type"), "text/javascript; charset=utf-8");
  EXPECT_EQ(request(port(), "GET", "/missing.js").status, 404);
}

TEST_F(BadInput, OneConnectionServesManyRequestsAlsoWhenSentAtOnce) {
  const std::string one = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string last = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  const RawResponse response = exchange(port(), one + one + last);
  EXPECT_EQ(response.status, 200);
  std::size_t answers = 1;  // the first one's head is parsed off
  for (std::size_t at = response.body.find("HTTP/1.1 200"); at != std::string::npos;
       at = response.body.find("HTTP/1.1 200", at + 1))
    ++answers;
  EXPECT_EQ(answers, 3u);
}

TEST(Serve, RefusesAnAddressThatOthersCanReachUnlessTold) {
  const TemporaryDirectory directory;
  try {
    const ServerProcess server(directory.path() / "data", {"--host", "0.0.0.0"});
    FAIL() << "it listens on every address";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("--allow-remote"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lather::server
