#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "server/artifacts/layout.h"
#include "server/artifacts/safe_read.h"
#include "server/http/api.h"
#include "server/http/byte_range.h"
#include "server/http/job_json.h"
#include "server/http/problem.h"
#include "server/http/zip_stream.h"
#include "server/run/run.h"

namespace lather::server {
namespace {

std::optional<int> frame_number(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

/// The whole, or the one range that was asked for.
HttpResponse bytes_response(const HttpRequest& request, std::string bytes) {
  HttpResponse response;
  response.headers.emplace_back("Accept-Ranges", "bytes");
  const auto range = read_range(request.header("range"), bytes.size());
  const std::string total = std::to_string(bytes.size());
  if (std::holds_alternative<UnsatisfiableRange>(range)) {
    response = HttpError(416, "the range lies outside the file's " + total + " bytes").response();
    response.headers.emplace_back("Content-Range", "bytes */" + total);
  } else if (const ByteRange* part = std::get_if<ByteRange>(&range)) {
    response.status = 206;
    response.headers.emplace_back("Content-Range", "bytes " + std::to_string(part->first) + '-' +
                                                       std::to_string(part->first + part->size - 1) + '/' +
                                                       total);
    response.body = bytes.substr(part->first, part->size);
  } else {
    response.body = std::move(bytes);
  }
  return response;
}

/// Counts a stream for as long as any copy of it lives.
std::shared_ptr<void> take_stream(std::atomic<int>& streams, int most) {
  if (streams.fetch_add(1) < most) return {&streams, [](std::atomic<int>* count) { count->fetch_sub(1); }};
  streams.fetch_sub(1);
  return nullptr;
}

/// Pictures a second: the scene's own rate, as far as a screen can show it, or "fps".
double film_rate(const HttpRequest& request, const Job& job) {
  constexpr double kSlowest = 1;
  constexpr double kFastest = 60;
  double rate = std::clamp(job.frame_rate, kSlowest, kFastest);
  for (const auto& [name, value] : request.parameters) {
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), rate);
    const bool whole = error == std::errc{} && end == value.data() + value.size();
    if (name != "fps" || !whole || !(rate >= kSlowest && rate <= kFastest))
      throw HttpError(400, "the query is not usable",
                      {{"", name + '=' + value, "fps=1 to fps=60", "a film has 'fps' alone to choose"}});
  }
  return rate;
}

/// All bytes of the file, a piece at a time.
bool send_file(int fd, const BodySink& sink) {
  std::array<char, 65536> piece{};
  while (true) {
    const ssize_t got = ::read(fd, piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return got == 0;
    if (!sink({piece.data(), static_cast<std::size_t>(got)})) return false;
  }
}

}  // namespace

HttpResponse Api::list_frames(const std::string& id) {
  const Job job = need_job(id);
  return json_response(200, write_json(frames_value(job, store_.frames(id)), 2));
}

FrameRow Api::need_frame(const Job& job, const std::string& number) {
  const std::optional<int> index = frame_number(number);
  const std::optional<FrameRow> frame = index ? store_.frame(job.id, *index) : std::nullopt;
  if (!frame)
    throw HttpError(404, "there is no frame " + number.substr(0, 20) + " (yet); the job has " +
                             std::to_string(job.progress.frames) + " when it is done");
  return *frame;
}

HttpResponse Api::get_frame(const HttpRequest& request, const std::string& id, const std::string& number) {
  const FrameRow frame = need_frame(need_job(id), number);
  const std::string tag = '"' + frame.sha256 + '"';
  HttpResponse response;
  if (request.header("if-none-match").find(tag) != std::string::npos) {
    response.status = 304;
  } else {
    std::optional<std::string> bytes = read_frame(id, frame);
    if (!bytes) throw HttpError(404, "the frame's file is gone from the data directory");
    response = bytes_response(request, std::move(*bytes));
    if (response.status < 300) response.content_type = "image/png";
  }
  response.headers.emplace_back("ETag", tag);
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

// Particles of a large job are hundreds of megabytes a frame: streamed, never held.
HttpResponse Api::get_file(const std::string& id, const std::string& number, const FrameFileKind& kind) {
  const FrameRow frame = need_frame(need_job(id), number);
  const std::shared_ptr<void> place = take_stream(streams_, settings_.most_streams);
  if (!place) return busy_response("too many downloads are under way");
  const auto file = std::make_shared<const OwnedFd>(open_beneath(
      job_directory(settings_.data, id),
      attempt_path(frame.attempt) + '/' + kind.folder + '/' + frame_file_name(frame.index, kind.ending)));
  if (!*file)
    throw HttpError(404, "the job keeps no " + kind.folder + " as " + kind.ending +
                             ": its scene asks for them by \"" + kind.folder + "\": [\"" + kind.ending +
                             "\"] in \"output\"");
  HttpResponse response;
  response.content_type = kind.ending == "obj" ? "model/obj" : "application/octet-stream";
  response.headers.emplace_back("Content-Disposition",
                                "attachment; filename=\"" + frame_file_name(frame.index, kind.ending) + "\"");
  response.headers.emplace_back("Cache-Control", "no-store");
  response.stream = [file, place](const BodySink& sink) { return send_file(file->get(), sink); };
  return response;
}

HttpResponse Api::get_zip(const std::string& id) {
  const Job job = need_job(id);
  const std::shared_ptr<void> place = take_stream(streams_, settings_.most_streams);
  if (!place) return busy_response("too many downloads are under way");
  std::vector<ZipEntry> entries;
  for (const FrameRow& frame : store_.frames(id))
    entries.push_back({frame_file_name(frame.index), [this, id, frame] { return read_frame(id, frame); }});
  HttpResponse response;
  response.content_type = "application/zip";
  response.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + id + ".zip\"");
  response.headers.emplace_back("Cache-Control", "no-store");
  response.stream = [entries = std::move(entries), place](const BodySink& sink) {
    return write_zip(entries, sink);
  };
  return response;
}

HttpResponse Api::get_film(const HttpRequest& request, const std::string& id, FilmKind kind) {
  const Job job = need_job(id);
  const double rate = film_rate(request, job);
  const std::optional<std::filesystem::path> ffmpeg = find_program(settings_.ffmpeg);
  if (!ffmpeg)
    throw HttpError(501,
                    "this server cannot make films: install ffmpeg on its machine, or name it with --ffmpeg");
  const std::vector<FrameRow> frames = store_.frames(id);
  if (frames.empty()) throw HttpError(404, "there are no frames yet to make a film of");
  const std::shared_ptr<void> place = take_stream(films_, settings_.most_films);
  if (!place) return busy_response("too many films are being made");
  const std::string ending = kind == FilmKind::kMp4 ? "mp4" : "webm";
  HttpResponse response;
  response.content_type = "video/" + ending;
  response.headers.emplace_back("Content-Disposition", "attachment; filename=\"" + id + '.' + ending + '"');
  response.headers.emplace_back("Cache-Control", "no-store");
  response.stream = [this, id, kind, rate, place, program = *ffmpeg, frames](const BodySink& sink) {
    std::size_t at = 0;
    const auto next = [&]() -> std::optional<std::string> {
      if (at == frames.size()) return std::nullopt;
      std::optional<std::string> picture = read_frame(id, frames[at++]);
      if (!picture) throw std::runtime_error("a frame's file is gone");
      return picture;
    };
    try {
      return write_film(program, kind, rate, next, sink);
    } catch (const std::exception& failure) {  // the head is sent: the client sees a body without an end
      spdlog::error("job {}: its film cannot be made: {}", id, failure.what());
      return false;
    }
  };
  return response;
}

HttpResponse Api::get_report(const std::string& id) {
  const Job job = need_job(id);
  std::optional<std::string> report =
      read_beneath(job_directory(settings_.data, id), attempt_path(job.attempt) + '/' + kReportName);
  if (!report)
    throw HttpError(404, "there is no report: it is written when a run ends by itself; the job is " +
                             std::string(to_string(job.state)));
  return json_response(200, std::move(*report));
}

HttpResponse Api::get_probes(const HttpRequest& request, const std::string& id) {
  const Job job = need_job(id);
  std::optional<std::string> csv =
      read_beneath(job_directory(settings_.data, id), attempt_path(job.attempt) + '/' + kProbesName);
  if (!csv)
    throw HttpError(404,
                    std::string("there are no samples: the scene has no probes, or the job has not ended "
                                "by itself yet; it is ") +
                        to_string(job.state));
  HttpResponse response = bytes_response(request, std::move(*csv));
  if (response.status < 300) response.content_type = "text/csv; charset=utf-8";
  response.headers.emplace_back("Cache-Control", "no-cache");
  return response;
}

HttpResponse Api::get_plan(const std::string& id) {
  static_cast<void>(need_job(id));
  return json_response(200, store_.plan(id).value_or("{}"));
}

HttpResponse Api::get_log(const std::string& id) {
  const Job job = need_job(id);
  std::optional<std::string> log =
      read_beneath(job_directory(settings_.data, id), attempt_path(job.attempt) + '/' + kLogName);
  if (!log) throw HttpError(404, "there is no log: no attempt has been started yet");
  HttpResponse response = json_response(200, std::move(*log));
  response.content_type = "text/plain; charset=utf-8";
  return response;
}

std::optional<std::string> Api::read_frame(const std::string& id, const FrameRow& frame) const {
  const auto read = [&](const FrameRow& row) {
    return read_beneath(job_directory(settings_.data, id),
                        attempt_path(row.attempt) + '/' + kFramesPath + '/' + frame_file_name(row.index));
  };
  if (std::optional<std::string> bytes = read(frame)) return bytes;
  // A newer attempt may have replaced it since the row was read.
  const std::optional<FrameRow> now = store_.frame(id, frame.index);
  return now && now->attempt != frame.attempt ? read(*now) : std::nullopt;
}

}  // namespace lather::server
