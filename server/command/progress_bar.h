#pragma once

#include <chrono>
#include <string>

namespace lather::server {

/// Progress for people on stderr: one line that is drawn over on a terminal, a plain line every few seconds
/// elsewhere.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();  ///< ends the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` 0 … 1; `eta_seconds` negative where it is not known.
  void show(double fraction, double eta_seconds, const std::string& text);
  /// A line of its own, above the bar.
  void line(const std::string& text);

 private:
  void clear();

  const bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_{};
};

/// "1 h 05 min", "3 min 20 s", "12 s"
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace lather::server
