#include "server/job/job.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>
#include <utility>

#include "server/artifacts/digest.h"

namespace lather::server {
namespace {

using S = JobState;

constexpr std::array<std::pair<S, const char*>, 8> kNames = {{{S::kQueued, "queued"},
                                                              {S::kRunning, "running"},
                                                              {S::kPausing, "pausing"},
                                                              {S::kPaused, "paused"},
                                                              {S::kCancelling, "cancelling"},
                                                              {S::kCancelled, "cancelled"},
                                                              {S::kSucceeded, "succeeded"},
                                                              {S::kFailed, "failed"}}};

constexpr std::array<std::pair<S, S>, 18> kMoves = {{{S::kQueued, S::kRunning},
                                                     {S::kQueued, S::kPaused},
                                                     {S::kQueued, S::kCancelled},
                                                     {S::kRunning, S::kSucceeded},
                                                     {S::kRunning, S::kFailed},
                                                     {S::kRunning, S::kPausing},
                                                     {S::kRunning, S::kCancelling},
                                                     {S::kRunning, S::kQueued},
                                                     {S::kPausing, S::kPaused},
                                                     {S::kPausing, S::kSucceeded},
                                                     {S::kPausing, S::kFailed},
                                                     {S::kPausing, S::kCancelling},
                                                     {S::kPaused, S::kQueued},
                                                     {S::kPaused, S::kCancelled},
                                                     {S::kCancelling, S::kCancelled},
                                                     {S::kCancelled, S::kQueued},
                                                     {S::kSucceeded, S::kQueued},
                                                     {S::kFailed, S::kQueued}}};

}  // namespace

const char* to_string(JobState state) {
  for (const auto& [value, name] : kNames)
    if (value == state) return name;
  throw std::invalid_argument("no such job state");
}

JobState job_state_from_string(std::string_view word) {
  for (const auto& [value, name] : kNames)
    if (word == name) return value;
  throw std::invalid_argument("no job state is called '" + std::string(word) + "'");
}

bool can_move(JobState from, JobState to) {
  return std::find(kMoves.begin(), kMoves.end(), std::pair(from, to)) != kMoves.end();
}

bool has_ended(JobState state) {
  return state == S::kSucceeded || state == S::kFailed || state == S::kCancelled;
}

bool is_at_work(JobState state) {
  return state == S::kRunning || state == S::kPausing || state == S::kCancelling;
}

bool attempt_stands(JobState state) {
  return state == S::kRunning || state == S::kPausing;
}

JobState after_loss(JobState state, int losses) {
  switch (state) {
    case S::kRunning:
      return losses >= kMostLosses ? S::kFailed : S::kQueued;
    case S::kPausing:
      return S::kPaused;
    case S::kCancelling:
      return S::kCancelled;
    default:
      return state;
  }
}

std::string lost_too_often(const std::string& last) {
  return std::to_string(kMostLosses) +
         " attempts in a row were lost without a new checkpoint between them. The last one: " + last;
}

std::string new_job_id() {
  return random_token(kJobIdLength);
}

bool is_job_id(std::string_view text) {
  return text.size() == kJobIdLength && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
                  c == '-';
         });
}

std::int64_t now_ms() {
  using std::chrono::milliseconds;
  return std::chrono::duration_cast<milliseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string timestamp(std::int64_t ms) {
  const std::time_t seconds = static_cast<std::time_t>(ms / 1000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char date[32];
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &utc);
  char text[48];
  std::snprintf(text, sizeof text, "%s.%03dZ", date, static_cast<int>(ms % 1000));
  return text;
}

}  // namespace lather::server
