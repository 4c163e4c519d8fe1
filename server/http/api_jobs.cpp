#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "server/artifacts/layout.h"
#include "server/artifacts/whole_file.h"
#include "server/http/api.h"
#include "server/http/job_changes.h"
#include "server/http/job_json.h"
#include "server/http/problem.h"
#include "server/http/redraw_submission.h"
#include "server/http/submission.h"
#include "server/job/drawn_from.h"

namespace lather::server {
namespace {

constexpr std::size_t kMostListed = 200;

HttpError bad_parameter(const std::string& name, const std::string& value, const std::string& allowed) {
  return {400,
          "the query parameter '" + name + "' is not usable",
          {{"", value, allowed, "'" + name + "' must be " + allowed}}};
}

Listing read_listing(const HttpRequest& request) {
  Listing listing;
  for (const auto& [name, value] : request.parameters) {
    if (name == "limit") {
      const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), listing.limit);
      if (error != std::errc{} || end != value.data() + value.size() || listing.limit < 1 ||
          listing.limit > kMostListed)
        throw bad_parameter(name, value, "a whole number from 1 to 200");
    } else if (name == "cursor") {
      listing.cursor = value;
    } else if (name == "state") {
      try {
        listing.state = job_state_from_string(value);
      } catch (const std::invalid_argument&) {
        throw bad_parameter(name, value,
                            "queued, running, pausing, paused, cancelling, cancelled, "
                            "succeeded or failed");
      }
    } else {
      throw bad_parameter(name, value, "one of limit, cursor, state");
    }
  }
  return listing;
}

}  // namespace

HttpResponse Api::post_job(const HttpRequest& request) {
  return add_job(make_submission(request, read_posted_scene(request, settings_.limits)));
}

HttpResponse Api::post_render(const HttpRequest& request, const std::string& id) {
  const Job source = need_job(id);
  if (!has_ended(source.state))
    throw HttpError(409, "the job is " + std::string(to_string(source.state)) +
                             ": its particles are drawn again when it has ended");
  const std::string plan = store_.plan(id).value_or("");
  // The particles that this job drew, where it was one that drew again; else its own.
  const std::string from = drawn_from(plan).value_or(id);
  if (store_.count_frames(from) == 0) throw HttpError(409, "the job has no frames to draw again");
  return add_job(make_redraw(request, source, plan, from, settings_.limits));
}

HttpResponse Api::add_job(const Submission& submission) {
  require_room_in_queue();
  if (const std::optional<Job> earlier = store_.add(submission)) {
    if (earlier->request_digest != submission.job.request_digest)
      throw HttpError(422, "this Idempotency-Key was used before for another request: choose a new one");
    return job_response(200, *earlier);
  }
  agent_.wake();
  return job_response(201, need_job(submission.job.id));
}

HttpResponse Api::list_jobs(const HttpRequest& request) {
  const Listing listing = read_listing(request);
  JobPage page;
  try {
    page = store_.list(listing);
  } catch (const std::invalid_argument&) {
    throw bad_parameter("cursor", listing.cursor, "the next_cursor of an earlier page");
  }
  Array jobs;
  for (const Job& job : page.jobs) jobs.push_back(job_value(job, store_.count_frames(job.id)));
  Object answer = {{"jobs", std::move(jobs)}, {"next_cursor", nullptr}};
  if (!page.next_cursor.empty()) answer.back().second = page.next_cursor;
  return json_response(200, write_json(answer, 2));
}

HttpResponse Api::cancel_job(const std::string& id) {
  const Job before = need_job(id);
  if (!agent_.cancel(id)) throw HttpError(409, "the job has ended: " + std::string(to_string(before.state)));
  return job_response(202, need_job(id));
}

HttpResponse Api::pause_job(const std::string& id) {
  const Job before = need_job(id);
  if (!agent_.pause(id))
    throw HttpError(409, "the job cannot be paused: it is " + std::string(to_string(before.state)));
  return job_response(202, need_job(id));
}

HttpResponse Api::resume_job(const std::string& id) {
  const Job job = need_job(id);
  require_room_in_queue();
  if (!store_.requeue(id, JobState::kPaused))
    throw HttpError(409, "only a paused job is resumed: it is " + std::string(to_string(job.state)));
  return queued_again(id);
}

HttpResponse Api::retry_job(const std::string& id) {
  const Job job = need_job(id);
  require_room_in_queue();
  const bool unfinished = job.state == JobState::kFailed || job.state == JobState::kCancelled;
  if (!unfinished || !store_.requeue(id, job.state))
    throw HttpError(409, "only a job that failed or was cancelled is tried again: it is " +
                             std::string(to_string(job.state)));
  return queued_again(id);
}

HttpResponse Api::extend_job(const HttpRequest& request, const std::string& id) {
  const Job job = need_job(id);
  if (job.state != JobState::kSucceeded)
    throw HttpError(409,
                    "only a job that succeeded is made longer: it is " + std::string(to_string(job.state)));
  const LongerRun longer = make_longer(request, store_.plan(id).value_or(""), settings_.limits);
  require_room_in_queue();
  if (!store_.extend(id, longer)) throw HttpError(409, "someone else has just changed the job");
  return queued_again(id);
}

HttpResponse Api::set_priority(const HttpRequest& request, const std::string& id) {
  const Job job = need_job(id);
  if (!store_.set_priority(id, read_priority(request)))
    throw HttpError(409, "the job has ended: " + std::string(to_string(job.state)));
  return job_response(200, need_job(id));
}

HttpResponse Api::queued_again(const std::string& id) {
  agent_.wake();
  return job_response(202, need_job(id));
}

void Api::require_room_in_queue() {
  if (store_.count(JobState::kQueued) >= settings_.most_queued)
    throw HttpError(503, "the queue is full: try again when jobs have ended");
}

HttpResponse Api::delete_job(const std::string& id) {
  const Job job = need_job(id);
  if (!store_.remove(id))
    throw HttpError(409,
                    "the job is " + std::string(to_string(job.state)) + ": cancel it first, then delete it");
  static_cast<void>(remove_tree(job_directory(settings_.data, id)));  // what stays is swept at the next start
  HttpResponse response;
  response.status = 204;
  return response;
}

Job Api::need_job(const std::string& id) {
  std::optional<Job> job = is_job_id(id) ? store_.find(id) : std::nullopt;
  if (!job) throw HttpError(404, "there is no such job");
  return *job;
}

HttpResponse Api::job_response(int status, const Job& job) {
  HttpResponse response = json_response(status, write_json(job_value(job, store_.count_frames(job.id)), 2));
  if (status == 201) response.headers.emplace_back("Location", std::string(kApi) + "/jobs/" + job.id);
  return response;
}

}  // namespace lather::server
