#include "server/http/job_json.h"

#include <cstdint>
#include <utility>

namespace lather::server {
namespace {

Value time_or_null(std::int64_t ms) {
  if (ms == 0) return nullptr;
  return timestamp(ms);
}

Value text_or_null(const std::string& text) {
  if (text.empty()) return nullptr;
  return text;
}

Value time_left_or_null(const Job& job) {
  if (job.state != JobState::kRunning || job.progress.eta_seconds < 0) return nullptr;
  return job.progress.eta_seconds;
}

Value checkpoint_time_or_null(const Job& job) {
  if (job.checkpoint_time < 0) return nullptr;
  return job.checkpoint_time;
}

Value progress_value(const Job& job) {
  const JobProgress& progress = job.progress;
  return Object{{"frame", progress.frame},
                {"frames", progress.frames},
                {"time", progress.time},
                {"step", static_cast<std::int64_t>(progress.step)},
                {"fraction", job.state == JobState::kSucceeded ? 1.0 : progress.fraction},
                {"seconds_per_frame", progress.seconds_per_frame},
                {"eta_seconds", time_left_or_null(job)}};
}

Value links_value(const std::string& id) {
  const std::string self = std::string(kApi) + "/jobs/" + id;
  return Object{{"self", self},
                {"cancel", self + "/cancel"},
                {"pause", self + "/pause"},
                {"resume", self + "/resume"},
                {"retry", self + "/retry"},
                {"extend", self + "/extend"},
                {"priority", self + "/priority"},
                {"events", self + "/events"},
                {"frames", self + "/frames"},
                {"zip", self + "/frames.zip"},
                {"film", self + "/film.mp4"},
                {"report", self + "/report"},
                {"probes", self + "/probes.csv"},
                {"plan", self + "/plan"},
                {"log", self + "/log"}};
}

}  // namespace

Value job_value(const Job& job, std::size_t frames) {
  return Object{{"id", job.id},
                {"name", job.name},
                {"state", to_string(job.state)},
                {"priority", job.priority},
                {"created", time_or_null(job.created)},
                {"started", time_or_null(job.started)},
                {"ended", time_or_null(job.ended)},
                {"attempt", job.attempt},
                {"error", text_or_null(job.error)},
                {"points", static_cast<std::int64_t>(job.points)},
                {"frame_rate", job.frame_rate},
                {"frames", static_cast<std::int64_t>(frames)},
                {"checkpoint_time", checkpoint_time_or_null(job)},
                {"progress", progress_value(job)},
                {"links", links_value(job.id)}};
}

Value frame_value(const Job& job, const FrameRow& frame) {
  return Object{
      {"index", frame.index},
      {"time", job.frame_rate > 0 ? frame.index / job.frame_rate : 0.0},
      {"size", static_cast<std::int64_t>(frame.size)},
      {"sha256", frame.sha256},
      {"url", std::string(kApi) + "/jobs/" + job.id + "/frames/" + std::to_string(frame.index) + ".png"}};
}

Value frames_value(const Job& job, const std::vector<FrameRow>& frames) {
  Array rows;
  for (const FrameRow& frame : frames) rows.push_back(frame_value(job, frame));
  return Object{{"frames", std::move(rows)}};
}

}  // namespace lather::server
