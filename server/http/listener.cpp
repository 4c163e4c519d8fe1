#include "server/http/listener.h"

#include <httplib.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <exception>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "server/artifacts/digest.h"
#include "server/http/problem.h"
#include "server/http/worker_pool.h"

namespace lather::server {
namespace {

using Clock = std::chrono::steady_clock;

/// What the library reads: the head as we understood it, written anew. What it writes goes to the socket, at
/// no less than a slow modem's pace, for a client that does not read holds a thread.
class GuardedStream final : public httplib::Stream {
 public:
  GuardedStream(int fd, std::string head, const std::atomic<bool>& stopping)
      : fd_(fd), head_(std::move(head)), stopping_(stopping) {}

  [[nodiscard]] bool failed() const { return failed_; }

  bool is_readable() const override { return read_ < head_.size(); }
  bool is_writable() const override { return !failed_; }
  ssize_t read(char* to, std::size_t size) override {
    const std::size_t count = std::min(size, head_.size() - read_);
    std::copy_n(head_.data() + read_, count, to);
    read_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    std::size_t sent = 0;
    while (sent < size && !failed_) {
      const ssize_t count = ::send(fd_, from + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count > 0) {
        sent += static_cast<std::size_t>(count);
        deadline_ += std::chrono::milliseconds(1000 * count / kSlowestBytesPerSecond);
      } else if (!wait_for_room()) {
        failed_ = true;
      }
    }
    return failed_ ? -1 : static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  // The library compares it with FD_SETSIZE, which is a limit of select() and none of ours.
  socket_t socket() const override { return 0; }

 private:
  static constexpr long kSlowestBytesPerSecond = 8192;

  [[nodiscard]] bool wait_for_room() const {
    if (errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return false;
    while (!stopping_.load() && Clock::now() < deadline_) {
      pollfd room = {fd_, POLLOUT, 0};
      if (::poll(&room, 1, 100) > 0) return !(room.revents & (POLLERR | POLLHUP));
    }
    return false;
  }

  const int fd_;
  const std::string head_;
  const std::atomic<bool>& stopping_;
  std::size_t read_ = 0;
  bool failed_ = false;
  Clock::time_point deadline_ = Clock::now() + std::chrono::seconds(20);
};

/// Runs in the accepting thread: accepting only hands a socket on to the parking.
class InlineQueue final : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

std::string plain_head(const HttpRequest& request) {
  // The path is only shown to the library's own router, which never runs.
  return request.method + " / HTTP/1." + (request.version_1_0 ? "0" : "1") +
         "\r\nConnection: " + (request.keep_alive ? "Keep-Alive" : "close") + "\r\n\r\n";
}

HttpResponse error_with_id(const std::string& what) {
  const std::string id = random_token(12);
  spdlog::error("error {}: {}", id, what);
  HttpResponse response;
  response.status = 500;
  response.content_type = "application/problem+json";
  response.body = R"({"type": "about:blank", "title": "Internal Server Error", "status": 500, "detail": )"
                  R"("The server made a mistake; its log says more under error )" +
                  id + "\"}\n";
  return response;
}

const httplib::Headers kHeadersOfAll = {{"X-Content-Type-Options", "nosniff"},
                                        {"Referrer-Policy", "no-referrer"},
                                        {"X-Frame-Options", "DENY"},
                                        {"Cross-Origin-Resource-Policy", "same-origin"},
                                        {"Content-Security-Policy",
                                         "default-src 'none'; script-src 'self'; style-src 'self'; img-src "
                                         "'self' data: blob:; connect-src 'self'; "
                                         "form-action 'none'; frame-ancestors 'none'; base-uri 'none'"}};

/// Of a body that ends with the connection.
std::string head_without_length(const HttpResponse& response) {
  std::string head = "HTTP/1.1 " + std::to_string(response.status) + ' ' + reason_phrase(response.status) +
                     "\r\nContent-Type: " + response.content_type + "\r\nConnection: close\r\n";
  for (const auto& [name, value] : kHeadersOfAll) head.append(name).append(": ").append(value).append("\r\n");
  for (const auto& [name, value] : response.headers)
    head.append(name).append(": ").append(value).append("\r\n");
  return head + "\r\n";
}

}  // namespace

class Listener::Server final : public httplib::Server {
 public:
  Server(ListenerSettings settings, Listener::Handler handler)
      : access_(std::move(settings.hosts)),
        handler_(std::move(handler)),
        pool_(settings.threads, settings.most_waiting),
        parking_(settings.parking, [this](OwnedFd& connection, HttpRequest& request, std::string& rest) {
          return serve_soon(connection, request, rest);
        }) {
    new_task_queue = [] { return new InlineQueue; };
    set_default_headers(kHeadersOfAll);
    set_keep_alive_max_count(1000000);
    // Not the library's own, which let a second server take the same port unseen (SO_REUSEPORT).
    set_socket_options([](socket_t fd) {
      const int yes = 1;
      ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    set_pre_routing_handler([this](const httplib::Request&, httplib::Response& to) {
      fill(std::move(*current.response), *current.request, to);
      return HandlerResponse::Handled;
    });
    set_exception_handler(
        [](const httplib::Request&, httplib::Response& to, const std::exception_ptr&) { to.status = 500; });
  }

  ~Server() override { end(); }

  int start(const std::string& host, int port) {
    const int bound = port == 0 ? bind_to_any_port(host) : (bind_to_port(host, port) ? port : -1);
    if (bound < 0)
      throw std::runtime_error("cannot listen on " + host + " port " + std::to_string(port) +
                               ": it is taken, or no address of this machine (--port 0 takes a free one)");
    ::listen(svr_sock_,
             SOMAXCONN);  // the library's own backlog of 5 makes clients of a burst wait for seconds
    accepting_ = std::thread([this] { listen_after_bind(); });
    while (!is_running()) std::this_thread::yield();
    return bound;
  }

  void end() {
    stopping_.store(true);
    stop();
    if (accepting_.joinable()) accepting_.join();
    pool_.stop();
    parking_.stop();
  }

 private:
  bool process_and_close_socket(socket_t fd) override {
    const int yes = 1;
    ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    parking_.add(OwnedFd(fd));
    return true;
  }

  bool serve_soon(OwnedFd& connection, HttpRequest& request, std::string& rest) {
    struct Visit {
      OwnedFd connection;
      HttpRequest request;
      std::string rest;
    };
    const auto visit = std::make_shared<Visit>();
    std::function<void()> task = [this, visit] { serve(visit->connection, visit->request, visit->rest); };
    // Filled while still ours: the task may run as soon as it is added, and comes back unused when there is
    // no room.
    *visit = {std::move(connection), std::move(request), std::move(rest)};
    if (pool_.try_add(task)) return true;
    connection = std::move(visit->connection);
    return false;
  }

  void serve(OwnedFd& connection, const HttpRequest& request, std::string& rest) {
    HttpResponse response = answer(request);
    if (response.take_over) return response.take_over(std::move(connection), head_without_length(response));
    GuardedStream stream(connection.get(), plain_head(request), stopping_);
    bool closed = false;
    current = {&request, &response};
    const bool answered = process_request(stream, !request.keep_alive, closed, nullptr);
    current = {};
    if (answered && !stream.failed() && request.keep_alive && !closed && !stopping_.load())
      parking_.add(std::move(connection), std::move(rest));
  }

  HttpResponse answer(const HttpRequest& request) const {
    try {
      if (const auto refusal = access_.check(request))
        return HttpError(refusal->status, refusal->detail).response();
      return handler_(request);
    } catch (const std::exception& failure) {
      return error_with_id(failure.what());
    } catch (...) {
      return error_with_id("an exception of an unknown type");
    }
  }

  void fill(HttpResponse from, const HttpRequest& request, httplib::Response& to) const {
    to.status = from.status;
    for (const auto& [name, value] : from.headers) to.set_header(name, value);
    if (!from.stream) {
      if (from.status != 204 && from.status != 304) to.set_content(from.body, from.content_type);
      return;
    }
    const auto provide = [this, stream = std::move(from.stream)](std::size_t, httplib::DataSink& sink) {
      const auto write = [&](std::string_view bytes) {
        return !stopping_.load() && sink.write(bytes.data(), bytes.size());
      };
      if (!stream(write)) return false;
      sink.done();
      return true;
    };
    if (request.version_1_0)
      to.set_content_provider(from.content_type, provide);
    else
      to.set_chunked_content_provider(from.content_type, provide);
  }

  /// What the library is about to answer in this thread, and with what.
  struct Current {
    const HttpRequest* request = nullptr;
    HttpResponse* response = nullptr;
  };
  static thread_local Current current;

  const AccessRules access_;
  const Listener::Handler handler_;
  std::atomic<bool> stopping_{false};
  WorkerPool pool_;
  Parking parking_;
  std::thread accepting_;
};

thread_local Listener::Server::Current Listener::Server::current;

Listener::Listener(ListenerSettings settings, Handler handler)
    : server_(std::make_unique<Server>(std::move(settings), std::move(handler))) {}

Listener::~Listener() = default;

int Listener::start(const std::string& host, int port) {
  return server_->start(host, port);
}

void Listener::stop() {
  server_->end();
}

}  // namespace lather::server
