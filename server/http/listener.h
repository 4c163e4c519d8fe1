#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/http/access.h"
#include "server/http/message.h"
#include "server/http/parking.h"

namespace lather::server {

struct ListenerSettings {
  ParkingSettings parking;
  std::vector<std::string> hosts;  ///< names allowed in Host beside the loopback ones
  std::size_t threads = 32;
  std::size_t most_waiting = 256;  ///< whole requests before the threads; beyond: 503
};

/// HTTP, behind guards: what reaches `handler` is a whole, well-formed request of an allowed origin.
class Listener {
 public:
  /// `handler` runs on many threads at once. What it throws becomes a 500 with an error id.
  using Handler = std::function<HttpResponse(const HttpRequest&)>;

  Listener(ListenerSettings settings, Handler handler);
  ~Listener();  ///< stops
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Binds, starts listening on a thread of its own and returns the port (`port` 0: one that is free).
  /// Throws std::runtime_error when the address cannot be had.
  int start(const std::string& host, int port);

  /// Accepts no more, closes what waits, finishes the answers that are under way; streams are cut.
  void stop();

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace lather::server
