#include "server/command/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lather::server {
namespace {

constexpr int kCells = 30;
constexpr auto kPlainInterval = std::chrono::seconds(5);

}  // namespace

ProgressBar::ProgressBar() : terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::fputc('\n', stderr);
}

void ProgressBar::show(double fraction, double eta_seconds, const std::string& text) {
  const double part = std::clamp(fraction, 0.0, 1.0);
  const std::string left = eta_seconds >= 0 && part < 1 ? ", " + duration_text(eta_seconds) + " left" : "";
  if (!terminal_) {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kPlainInterval) return;
    last_ = now;
    std::fprintf(stderr, "%3.0f %%  %s%s\n", 100 * part, text.c_str(), left.c_str());
    return;
  }
  const int full = static_cast<int>(part * kCells);
  const std::string bar = std::string(static_cast<std::size_t>(full), '#') +
                          std::string(static_cast<std::size_t>(kCells - full), '.');
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s%s", bar.c_str(), 100 * part, text.c_str(), left.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::line(const std::string& text) {
  clear();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void ProgressBar::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

std::string duration_text(double seconds) {
  const long whole = std::max(0L, std::lround(seconds));
  char text[48];
  if (whole >= 3600)
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole / 60 % 60);
  else if (whole >= 60)
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%ld s", whole);
  return text;
}

}  // namespace lather::server
