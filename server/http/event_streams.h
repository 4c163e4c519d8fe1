#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "server/artifacts/owned_fd.h"
#include "server/store/store.h"

namespace lather::server {

struct EventStreamSettings {
  std::size_t most = 64;                           ///< streams at a time
  std::chrono::milliseconds pace{300};             ///< between two looks at the store
  std::chrono::milliseconds heartbeat{15'000};     ///< a comment, where there was nothing else to say
  std::chrono::milliseconds patience{20'000};      ///< with a client that does not read
  std::size_t most_unread = std::size_t{1} << 20;  ///< bytes that wait for one
};

/// Server-sent events of jobs, all written by one thread that never waits for a client: a stream takes a
/// descriptor and a small buffer, and no thread of those that answer requests.
///
/// Events are drawn from the store, not from a log of what happened: "job" (the job's document, at the start
/// and whenever it has changed), "frame" (a row of the frames' listing, in order of the index) and "end",
/// once the job has ended. The id of an event is the index from which on frames are still to be told, so that
/// a client that comes back with Last-Event-ID misses none.
class EventStreams {
 public:
  explicit EventStreams(Store& store, EventStreamSettings settings = {});
  ~EventStreams();  ///< ends all streams
  EventStreams(const EventStreams&) = delete;
  EventStreams& operator=(const EventStreams&) = delete;

  /// A place for one more stream, held by whoever holds the pointer; null when there is none.
  [[nodiscard]] std::shared_ptr<void> take_place();

  /// Serves the client at the other end from now on. `head`: bytes that go before the events. `first_frame`:
  /// the first one to tell of.
  void add(OwnedFd client, std::string head, const std::string& job, int first_frame,
           std::shared_ptr<void> place);

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

/// The index that a Last-Event-ID stands for; 0 for "" and for what is no id of ours.
[[nodiscard]] int frame_of_event_id(const std::string& id);

/// One event as bytes of the stream. `data` is one line.
[[nodiscard]] std::string event_bytes(const std::string& event, int id, const std::string& data);

}  // namespace lather::server
