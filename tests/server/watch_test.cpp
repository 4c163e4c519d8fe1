// Jobs and the server as seen from outside while they work: event streams, metrics, readiness.

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/server/blackbox.h"

namespace lather::server {
namespace {

struct Event {
  std::string name;
  std::string id;
  std::string data;
};

/// A client that listens to one job's events.
class Listening {
 public:
  Listening(int port, const std::string& path, const std::string& header_lines = {}) : fd_(connect_to(port)) {
    const std::string bytes = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n" + header_lines + "\r\n";
    ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  ~Listening() { ::close(fd_); }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

  /// Reads on until the head is whole; the number in it.
  int status() {
    while (head_.empty() && read_on()) {
    }
    return head_.size() > 12 ? std::stoi(head_.substr(9, 3)) : 0;
  }
  const std::string& head() const { return head_; }

  /// Reads on until an event of this name; false when the stream ends before.
  bool hears(const std::string& name) {
    while (true) {
      for (; looked_at_ < events.size(); ++looked_at_)
        if (events[looked_at_].name == name) return ++looked_at_ > 0;
      if (!read_on()) return false;
    }
  }
  bool ends() {
    while (read_on()) {
    }
    return at_end_;
  }

  std::vector<Event> events;

 private:
  bool read_on() {
    pollfd readable = {fd_, POLLIN, 0};
    if (::poll(&readable, 1, 60'000) <= 0) return false;
    char chunk[65536];
    const ssize_t got = ::recv(fd_, chunk, sizeof chunk, 0);
    at_end_ = got == 0;
    if (got <= 0) return false;
    bytes_.append(chunk, static_cast<std::size_t>(got));
    while (true) {
      const std::string gap = head_.empty() ? "\r\n\r\n" : "\n\n";
      const std::size_t end = bytes_.find(gap);
      if (end == std::string::npos) return true;
      const std::string part = bytes_.substr(0, end);
      bytes_.erase(0, end + gap.size());
      if (head_.empty())
        head_ = part;
      else if (part[0] != ':')
        events.push_back(parse(part));
    }
  }
  static Event parse(const std::string& part) {
    std::map<std::string, std::string> fields;
    std::size_t at = 0;
    while (at < part.size()) {
      const std::size_t end = std::min(part.find('\n', at), part.size());
      const std::string line = part.substr(at, end - at);
      fields[line.substr(0, line.find(": "))] = line.substr(line.find(": ") + 2);
      at = end + 1;
    }
    return {fields["event"], fields["id"], fields["data"]};
  }

  const int fd_;
  std::string head_;
  std::string bytes_;
  std::size_t looked_at_ = 0;
  bool at_end_ = false;
};

class Watch : public Blackbox {
 protected:
  static std::vector<int> frames_of(const std::vector<Event>& events) {
    std::vector<int> frames;
    for (const Event& event : events)
      if (event.name == "frame") frames.push_back(Json::parse(event.data).at("index"));
    return frames;
  }
  double metric(const std::string& name) {
    const std::string text = '\n' + request(port(), "GET", "/metrics").body;
    const std::size_t at = text.find('\n' + name + ' ');
    return at == std::string::npos ? -1 : std::stod(text.substr(at + name.size() + 2));
  }
};

TEST_F(Watch, EventsTellOfEveryFrameAndTheEndAndGoOnWhereTheyWereCutOff) {
  start();
  const std::string id = post_job(small_scene());
  Listening first(port(), path(id, "/events"));
  ASSERT_EQ(first.status(), 200);
  EXPECT_NE(first.head().find("Content-Type: text/event-stream"), std::string::npos) << first.head();
  EXPECT_NE(first.head().find("nosniff"), std::string::npos);
  ASSERT_TRUE(first.hears("job"));
  ASSERT_TRUE(first.hears("frame"));
  ASSERT_TRUE(first.hears("end"));
  EXPECT_TRUE(first.ends());
  EXPECT_EQ(frames_of(first.events), (std::vector<int>{0, 1, 2, 3}));
  const Event& last = first.events[first.events.size() - 2];
  EXPECT_EQ(last.name, "job");
  EXPECT_EQ(last.id, "4");
  EXPECT_EQ(Json::parse(last.data), job(id));
  const Json row = Json::parse(request(port(), "GET", path(id, "/frames")).body).at("frames").at(2);
  for (const Event& event : first.events) {
    const bool third_frame = event.name == "frame" && event.id == "3";
    if (third_frame) {
      EXPECT_EQ(Json::parse(event.data), row);
    }
  }

  Listening second(port(), path(id, "/events"), "Last-Event-ID: 2\r\n");
  ASSERT_TRUE(second.hears("end"));
  EXPECT_EQ(frames_of(second.events), (std::vector<int>{2, 3}));
  Listening third(port(), path(id, "/events"), "Last-Event-ID: 4\r\n");
  EXPECT_EQ(third.status(), 204) << "a browser need not ask again";
  EXPECT_EQ(request(port(), "HEAD", path(id, "/events")).status, 200);
  EXPECT_EQ(request(port(), "GET", path("aaaaaaaaaaaaaaaaaaaaaa", "/events")).status, 404);
}

TEST_F(Watch, ManyListenersStarveNobodyAndMoreAreSentAway) {
  start({"--workers", "0"});
  const std::string id = post_job(small_scene());
  std::vector<std::unique_ptr<Listening>> all;
  for (int i = 0; i < 64; ++i) {
    all.push_back(std::make_unique<Listening>(port(), path(id, "/events")));
    ASSERT_TRUE(all.back()->hears("job")) << i;
  }
  EXPECT_EQ(request(port(), "GET", "/healthz").status, 200) << "twice as many as there are threads";
  const RawResponse more = request(port(), "GET", path(id, "/events"));
  EXPECT_EQ(more.status, 503);
  EXPECT_EQ(more.headers.count("retry-after"), 1U);
  all.clear();
  EXPECT_TRUE(eventually([&] { return Listening(port(), path(id, "/events")).status() == 200; }))
      << "places come free";
}

TEST_F(Watch, EventsTellOfWhatIsAskedOfAJobAndOfItsRemoval) {
  start({"--workers", "0"});
  const std::string id = post_job(small_scene());
  Listening listening(port(), path(id, "/events"));
  ASSERT_TRUE(listening.hears("job"));
  EXPECT_EQ(request(port(), "POST", path(id, "/pause")).status, 202);
  ASSERT_TRUE(listening.hears("job"));
  EXPECT_EQ(Json::parse(listening.events.back().data).at("state"), "paused");
  EXPECT_EQ(request(port(), "POST", path(id, "/cancel")).status, 202);
  ASSERT_TRUE(listening.hears("job"));
  EXPECT_TRUE(listening.hears("end"));
  EXPECT_TRUE(listening.ends());
}

TEST_F(Watch, MetricsCountWhatHappened) {
  start({"--checkpoint-seconds", "3600"});
  EXPECT_EQ(metric("lather_frames_total"), 0);
  const std::string good = post_job(small_scene());
  ASSERT_TRUE(reaches(good, "succeeded"));
  Json scene = small_scene();
  scene["numerics"] = {{"time_step", 0.01}};  // it runs away
  const std::string bad = post_job(scene);
  ASSERT_TRUE(reaches(bad, "failed"));
  const std::string lost = post_job(long_scene());
  ASSERT_TRUE(has_frames(lost, 1));
  for (const pid_t runner : server_->runners()) ::kill(runner, SIGKILL);
  ASSERT_TRUE(eventually([&] { return job(lost).at("attempt") == 2; }));
  EXPECT_EQ(request(port(), "POST", path(lost, "/cancel")).status, 202);
  ASSERT_TRUE(reaches(lost, "cancelled"));
  EXPECT_EQ(metric("lather_jobs{state=\"succeeded\"}"), 1);
  EXPECT_EQ(metric("lather_jobs{state=\"queued\"}"), 0);
  EXPECT_TRUE(eventually([&] { return metric("lather_attempts_total{outcome=\"cancelled\"}") == 1; }));
  EXPECT_EQ(metric("lather_attempts_total{outcome=\"succeeded\"}"), 1);
  EXPECT_EQ(metric("lather_attempts_total{outcome=\"lost\"}"), 1);
  EXPECT_EQ(metric("lather_failures_total{cause=\"simulation\"}"), 1);
  EXPECT_EQ(metric("lather_attempt_seconds_count"), 4);
  EXPECT_GE(metric("lather_frames_total"), 5);
  EXPECT_GE(metric("lather_checkpoints_total"), 1) << "that of the end";
  EXPECT_GT(metric("lather_point_steps_total"), 0);
  EXPECT_GT(metric("lather_disk_free_bytes"), 0);
  EXPECT_EQ(request(port(), "GET", "/metrics").headers.at("content-type").rfind("text/plain", 0), 0U);
}

TEST_F(Watch, AServerThatAnswersIsReady) {
  start({"--workers", "0"});
  const RawResponse ready = request(port(), "GET", "/readyz");
  EXPECT_EQ(ready.status, 200);
  EXPECT_EQ(Json::parse(ready.body), Json({{"ready", true}, {"store", "ok"}, {"disk", "ok"}}));
}

}  // namespace
}  // namespace lather::server
