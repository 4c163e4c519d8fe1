#include "server/http/parking.h"

#include <fcntl.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "server/http/problem.h"

namespace lather::server {
namespace {

using Clock = std::chrono::steady_clock;

// A refused client may still be sending. Closing then would reset the connection and lose the answer, so what
// it sends is read and thrown away, for this long and this much.
constexpr auto kDrainDeadline = std::chrono::milliseconds(1500);
constexpr std::size_t kMostDrained = std::size_t{128} << 20;
constexpr std::size_t kReadAtOnce = 65536;

struct Connection {
  OwnedFd fd;
  std::string bytes;
  std::optional<RequestHead> head;
  std::size_t head_bytes = 0;
  Clock::time_point deadline;
  bool draining = false;
  std::size_t drained = 0;
};

}  // namespace

class Parking::Loop {
 public:
  Loop(ParkingSettings settings, Ready ready)
      : settings_(settings),
        ready_(std::move(ready)),
        epoll_(::epoll_create1(EPOLL_CLOEXEC)),
        wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!epoll_ || !wake_) throw std::system_error(errno, std::generic_category(), "cannot make an epoll");
    watch(wake_.get());
    thread_ = std::thread([this] { main(); });
  }

  ~Loop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake();
    thread_.join();
  }

  void add(OwnedFd fd, std::string rest) {
    {
      const std::lock_guard lock(mutex_);
      arrived_.emplace_back(std::move(fd), std::move(rest));
    }
    wake();
  }

 private:
  void wake() const {
    const std::uint64_t one = 1;
    while (::write(wake_.get(), &one, sizeof one) < 0 && errno == EINTR) {
    }
  }

  void watch(int fd) const {
    epoll_event event{};
    event.events = EPOLLIN | EPOLLRDHUP;
    event.data.fd = fd;
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, fd, &event);
  }

  void main() {
    epoll_event events[64];
    while (true) {
      const int count = ::epoll_wait(epoll_.get(), events, 64, time_to_next_deadline());
      for (int i = 0; i < count; ++i) {
        const int fd = events[i].data.fd;
        if (fd != wake_.get()) on_readable(fd);
      }
      if (!admit_arrived()) return;
      close_late();
    }
  }

  /// ms; all deadlines are looked at, for there are a thousand at most.
  [[nodiscard]] int time_to_next_deadline() const {
    Clock::time_point next = Clock::time_point::max();
    for (const auto& [fd, connection] : waiting_) next = std::min(next, connection.deadline);
    if (next == Clock::time_point::max()) return -1;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next - Clock::now()).count();
    return static_cast<int>(std::max<long long>(0, left + 1));
  }

  /// False when it is time to end.
  bool admit_arrived() {
    std::uint64_t count = 0;
    while (::read(wake_.get(), &count, sizeof count) < 0 && errno == EINTR) {
    }
    std::vector<std::pair<OwnedFd, std::string>> arrived;
    {
      const std::lock_guard lock(mutex_);
      if (stopping_) return false;
      arrived.swap(arrived_);
    }
    for (auto& [fd, rest] : arrived) admit(std::move(fd), std::move(rest));
    return true;
  }

  void admit(OwnedFd owned, std::string rest) {
    const int fd = owned.get();
    ::fcntl(fd, F_SETFD, FD_CLOEXEC);
    ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
    Connection& connection = waiting_[fd];
    connection = Connection{};
    connection.fd = std::move(owned);
    connection.deadline = Clock::now() + (rest.empty() ? settings_.idle_deadline : settings_.head_deadline);
    connection.bytes = std::move(rest);
    watch(fd);
    if (waiting_.size() > settings_.most_connections)
      refuse(connection, {503, "too many connections are open: try again"});
    else if (!connection.bytes.empty())
      examine(fd, connection);
  }

  void on_readable(int fd) {
    const auto found = waiting_.find(fd);
    if (found == waiting_.end()) return;
    Connection& connection = found->second;
    char chunk[kReadAtOnce];
    const ssize_t got = ::recv(fd, chunk, sizeof chunk, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) {
      drop(fd);
    } else if (connection.draining) {
      connection.drained += static_cast<std::size_t>(got);
      if (connection.drained > kMostDrained) drop(fd);
    } else {
      if (connection.bytes.empty()) connection.deadline = Clock::now() + settings_.head_deadline;
      connection.bytes.append(chunk, static_cast<std::size_t>(got));
      examine(fd, connection);
    }
  }

  void examine(int fd, Connection& connection) {
    if (!connection.head && !take_head(connection)) return;
    const std::size_t whole = connection.head_bytes + connection.head->body_bytes;
    if (connection.bytes.size() >= whole)
      hand_over(fd, connection, whole);
    else if (std::exchange(connection.head->expects_continue, false))
      send_now(fd, "HTTP/1.1 100 Continue\r\n\r\n");
  }

  bool take_head(Connection& connection) {
    const std::size_t most = settings_.limits.head_bytes;
    const std::size_t end = std::string_view(connection.bytes).substr(0, most).find("\r\n\r\n");
    if (end == std::string::npos) {
      if (connection.bytes.size() >= most)
        refuse(connection, {431, "the request's head is larger than " + std::to_string(most) + " bytes"});
      return false;
    }
    connection.head_bytes = end + 4;
    auto outcome = read_request_head(std::string_view(connection.bytes).substr(0, connection.head_bytes),
                                     settings_.limits);
    if (const Refusal* bad = std::get_if<Refusal>(&outcome)) {
      refuse(connection, *bad);
      return false;
    }
    connection.head = std::move(std::get<RequestHead>(outcome));
    connection.deadline = Clock::now() + settings_.body_deadline;
    return true;
  }

  void hand_over(int fd, Connection& connection, std::size_t whole) {
    HttpRequest& request = connection.head->request;
    request.body = connection.bytes.substr(connection.head_bytes, connection.head->body_bytes);
    std::string rest = connection.bytes.substr(whole);
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
    if (ready_(connection.fd, request, rest)) {
      waiting_.erase(fd);
      return;
    }
    watch(fd);
    refuse(connection, {503, "the server is busy: try again"});
  }

  void refuse(Connection& connection, const Refusal& refusal) {
    send_now(connection.fd.get(), refusal_bytes(refusal));
    ::shutdown(connection.fd.get(), SHUT_WR);
    connection.draining = true;
    connection.bytes.clear();
    connection.deadline = Clock::now() + kDrainDeadline;
  }

  /// A short answer fits an empty send buffer; a client that left none has not earned one.
  static void send_now(int fd, const std::string& bytes) {
    static_cast<void>(::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT));
  }

  void close_late() {
    const auto now = Clock::now();
    std::vector<int> late;
    for (const auto& [fd, connection] : waiting_)
      if (connection.deadline <= now) late.push_back(fd);
    for (const int fd : late) {
      Connection& connection = waiting_[fd];
      if (connection.draining || connection.bytes.empty())
        drop(fd);
      else
        refuse(connection, {408, "the request did not arrive in time"});
    }
  }

  void drop(int fd) {
    ::epoll_ctl(epoll_.get(), EPOLL_CTL_DEL, fd, nullptr);
    waiting_.erase(fd);
  }

  const ParkingSettings settings_;
  const Ready ready_;
  const OwnedFd epoll_;
  const OwnedFd wake_;
  std::map<int, Connection> waiting_;  // by descriptor; only the loop's thread touches it

  std::mutex mutex_;
  bool stopping_ = false;  // guarded by mutex_, as is the next
  std::vector<std::pair<OwnedFd, std::string>> arrived_;
  std::thread thread_;
};

Parking::Parking(ParkingSettings settings, Ready ready)
    : loop_(std::make_unique<Loop>(settings, std::move(ready))) {}

Parking::~Parking() = default;

void Parking::add(OwnedFd connection, std::string rest) {
  if (loop_) loop_->add(std::move(connection), std::move(rest));
}

void Parking::stop() {
  loop_.reset();
}

}  // namespace lather::server
