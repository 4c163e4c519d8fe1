#include "server/http/event_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <exception>
#include <list>
#include <map>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "server/http/job_json.h"
#include "sim/scene/value.h"

namespace lather::server {
namespace {

using Clock = std::chrono::steady_clock;

struct Client {
  OwnedFd fd;
  std::string job;
  std::string unread;  ///< not yet taken by the socket
  int next_frame = 0;
  std::string told;     ///< the job's document as it was last told of
  bool fresh = true;    ///< nothing has been told yet
  bool ending = false;  ///< closed as soon as nothing is unread
  bool gone = false;
  Clock::time_point last_said = Clock::now();
  Clock::time_point last_taken = Clock::now();  ///< when the socket took bytes, or there were none
  std::shared_ptr<void> place;
};

/// What one look at the store found of a job.
struct Sight {
  std::string document;  ///< one line
  bool ended = false;
  std::vector<FrameRow> frames;  ///< from the first one that any client lacks
  Job job;
};

}  // namespace

class EventStreams::Loop {
 public:
  Loop(Store& store, EventStreamSettings settings)
      : store_(store), settings_(settings), wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (!wake_) throw std::system_error(errno, std::generic_category(), "cannot make an eventfd");
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

  std::shared_ptr<void> take_place() {
    if (places_->fetch_add(1) < settings_.most)
      return {places_.get(), [places = places_](std::atomic<std::size_t>* count) { count->fetch_sub(1); }};
    places_->fetch_sub(1);
    return nullptr;
  }

  void add(Client client) {
    {
      const std::lock_guard lock(mutex_);
      arrived_.push_back(std::move(client));
    }
    wake();
  }

 private:
  void wake() const {
    const std::uint64_t one = 1;
    while (::write(wake_.get(), &one, sizeof one) < 0 && errno == EINTR) {
    }
  }

  void main() {
    Clock::time_point next_look = Clock::now();
    while (wait_until(next_look)) {
      const bool due = Clock::now() >= next_look;
      look_at_jobs(!due);
      if (due) next_look = Clock::now() + settings_.pace;
      for (Client& client : clients_) {
        keep_warm(client);
        send(client);
      }
      clients_.remove_if([](const Client& client) { return client.gone; });
    }
  }

  /// For news of sockets, of new clients, or the time. False when it is time to end.
  bool wait_until(Clock::time_point next_look) {
    std::vector<pollfd> watched = {{wake_.get(), POLLIN, 0}};
    for (const Client& client : clients_)
      watched.push_back(
          {client.fd.get(), static_cast<short>(POLLIN | (client.unread.empty() ? 0 : POLLOUT)), 0});
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(next_look - Clock::now()).count() + 1;
    // Without a client there is nothing to look at.
    const int timeout = clients_.empty() ? -1 : static_cast<int>(std::max<long long>(0, left));
    static_cast<void>(::poll(watched.data(), watched.size(), timeout));
    std::size_t i = 1;
    for (Client& client : clients_)
      if (watched[i++].revents & (POLLIN | POLLHUP | POLLERR)) discard_input(client);
    return admit();
  }

  bool admit() {
    std::uint64_t count = 0;
    while (::read(wake_.get(), &count, sizeof count) < 0 && errno == EINTR) {
    }
    const std::lock_guard lock(mutex_);
    clients_.splice(clients_.end(), arrived_);
    return !stopping_;
  }

  /// A client of a stream has nothing to say; what it does send is thrown away.
  static void discard_input(Client& client) {
    char chunk[4096];
    const ssize_t got = ::recv(client.fd.get(), chunk, sizeof chunk, MSG_DONTWAIT);
    client.gone = got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
  }

  /// A new client need not wait for the time of the next look.
  void look_at_jobs(bool only_for_fresh) {
    const auto wants = [&](const Client& client) {
      return !client.ending && (client.fresh || !only_for_fresh);
    };
    std::map<std::string, int> first_wanted;
    for (const Client& client : clients_) {
      if (!wants(client)) continue;
      const auto [at, is_new] = first_wanted.emplace(client.job, client.next_frame);
      at->second = std::min(at->second, client.next_frame);
    }
    for (const auto& [job, first] : first_wanted) {
      try {
        const std::optional<Sight> sight = look_at(job, first);
        for (Client& client : clients_)
          if (client.job == job && wants(client)) tell(client, sight);
      } catch (const std::exception& failure) {  // streams outlast a store that is away for a while
        spdlog::warn("job {} cannot be looked at for its streams: {}", job, failure.what());
        return;
      }
    }
  }

  std::optional<Sight> look_at(const std::string& id, int first) {
    Sight sight;
    // The job before its frames: one that has ended then has all of them.
    const std::optional<Job> job = store_.find(id);
    if (!job) return std::nullopt;
    sight.job = *job;
    sight.frames = store_.frames(id, first);
    sight.document = write_json(job_value(*job, store_.count_frames(id)));
    sight.ended = has_ended(job->state);
    return sight;
  }

  void tell(Client& client, const std::optional<Sight>& sight) const {
    client.fresh = false;
    if (!sight) {  // deleted
      say(client, "end", "{}");
      client.ending = true;
      return;
    }
    for (const FrameRow& frame : sight->frames) {
      if (frame.index < client.next_frame) continue;
      if (client.unread.size() > settings_.most_unread / 2) return;  // the rest when it has read that
      client.next_frame = frame.index + 1;
      say(client, "frame", write_json(frame_value(sight->job, frame)));
    }
    if (client.told != sight->document) {
      client.told = sight->document;
      say(client, "job", client.told);
    }
    if (sight->ended) {
      say(client, "end", "{}");
      client.ending = true;
    }
  }

  void say(Client& client, const std::string& event, const std::string& data) const {
    client.unread += event_bytes(event, client.next_frame, data);
    client.last_said = Clock::now();
    if (client.unread.size() > settings_.most_unread) client.gone = true;
  }

  void keep_warm(Client& client) const {
    if (Clock::now() - client.last_said < settings_.heartbeat) return;
    client.unread += ": still here\n\n";
    client.last_said = Clock::now();
  }

  void send(Client& client) const {
    const auto now = Clock::now();
    while (!client.unread.empty()) {
      const ssize_t sent =
          ::send(client.fd.get(), client.unread.data(), client.unread.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (sent < 0 && errno == EINTR) continue;
      if (sent < 0) {
        const bool full = errno == EAGAIN || errno == EWOULDBLOCK;
        if (!full || now - client.last_taken > settings_.patience) client.gone = true;
        return;
      }
      client.unread.erase(0, static_cast<std::size_t>(sent));
      client.last_taken = now;
    }
    client.last_taken = now;
    if (client.ending) client.gone = true;
  }

  Store& store_;
  const EventStreamSettings settings_;
  const OwnedFd wake_;
  // Shared, for a place may be given back by a request that outlives the loop.
  const std::shared_ptr<std::atomic<std::size_t>> places_ = std::make_shared<std::atomic<std::size_t>>(0);
  std::list<Client> clients_;  // only the loop's thread touches them

  std::mutex mutex_;
  bool stopping_ = false;  // guarded by mutex_, as is the next
  std::list<Client> arrived_;
  std::thread thread_;
};

EventStreams::EventStreams(Store& store, EventStreamSettings settings)
    : loop_(std::make_unique<Loop>(store, settings)) {}

EventStreams::~EventStreams() = default;

std::shared_ptr<void> EventStreams::take_place() {
  return loop_->take_place();
}

void EventStreams::add(OwnedFd client, std::string head, const std::string& job, int first_frame,
                       std::shared_ptr<void> place) {
  Client added;
  added.fd = std::move(client);
  added.unread = std::move(head);
  added.job = job;
  added.next_frame = first_frame;
  added.place = std::move(place);
  loop_->add(std::move(added));
}

int frame_of_event_id(const std::string& id) {
  int frame = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), frame);
  return error == std::errc{} && end == id.data() + id.size() && frame > 0 ? frame : 0;
}

std::string event_bytes(const std::string& event, int id, const std::string& data) {
  return "event: " + event + "\nid: " + std::to_string(id) + "\ndata: " + data + "\n\n";
}

}  // namespace lather::server
