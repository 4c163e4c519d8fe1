#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace lather::server {

/// Asks again and again until it is so; false when it is not by then.
[[nodiscard]] inline bool eventually(const std::function<bool()>& is_so,
                                     std::chrono::seconds patience = std::chrono::seconds(120)) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < deadline) {
    if (is_so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // only the pace of asking
  }
  return is_so();
}

}  // namespace lather::server
