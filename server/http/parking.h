#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/artifacts/owned_fd.h"
#include "server/http/message.h"
#include "server/http/request_head.h"

namespace lather::server {

struct ParkingSettings {
  RequestLimits limits;
  std::chrono::milliseconds head_deadline{10000};  ///< from the first byte to the head's end
  std::chrono::milliseconds body_deadline{30000};  ///< from there to the body's end
  std::chrono::milliseconds idle_deadline{20000};  ///< without a first byte
  std::size_t most_connections = 1024;
};

/// Connections wait here, all on one thread, until a whole request has arrived; only then does one take a
/// worker thread's time. So a thousand clients that send a byte a second cost a thousand small buffers and no
/// thread. What breaks the rules of request_head.h, or is late, is answered and closed here.
class Parking {
 public:
  /// Takes a whole request and its connection; `rest` are bytes that came after it. False when there is no
  /// room now: the client gets 503. The connection is moved from only when it was taken.
  using Ready = std::function<bool(OwnedFd& connection, HttpRequest& request, std::string& rest)>;

  Parking(ParkingSettings settings, Ready ready);
  ~Parking();  ///< stops
  Parking(const Parking&) = delete;
  Parking& operator=(const Parking&) = delete;

  /// From any thread. `rest`: bytes that have been read from it and not been used.
  void add(OwnedFd connection, std::string rest = {});
  void stop();  ///< closes all that wait

 private:
  class Loop;
  std::unique_ptr<Loop> loop_;
};

}  // namespace lather::server
