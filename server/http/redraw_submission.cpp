#include "server/http/redraw_submission.h"

#include <algorithm>

#include "server/http/problem.h"
#include "server/http/submission.h"
#include "server/job/drawn_from.h"
#include "server/run/redraw.h"
#include "sim/plan/plan.h"
#include "sim/scene/value.h"

namespace lather::server {
namespace {

struct Redraw {
  std::vector<Override> changes;
  int priority = 0;
};

Redraw read_redraw(const HttpRequest& request) {
  const Value body = read_json_body(request);
  if (!body.object()) throw HttpError(422, "the request must be an object: {\"look\": …} or {\"set\": …}");
  Redraw redraw;
  std::vector<Problem> problems;
  for (const auto& [key, value] : *body.object()) {
    if (key == "look") {
      redraw.changes.insert(redraw.changes.begin(), {"/look", write_json(value)});
    } else if (key == "set") {
      read_override_members(value, redraw.changes, problems);
    } else if (key == "priority") {
      read_priority_member(value, redraw.priority, problems);
    } else {
      problems.push_back({pointer_token(key), write_json(value).substr(0, 40), "look, set, priority",
                          "'" + key + "' is no member of this request"});
    }
  }
  if (!problems.empty()) throw HttpError(422, "the request cannot be used", problems);
  check_redrawn(redraw.changes);
  return redraw;
}

void check_kept(const Scene& scene) {
  const std::vector<std::string>& kept = scene.output.particles;
  if (std::find(kept.begin(), kept.end(), "ply") == kept.end())
    throw HttpError(409,
                    "the job keeps no particles: post its scene with \"output\": {\"particles\": [\"ply\"]}");
}

}  // namespace

Submission make_redraw(const HttpRequest& request, const Job& source, const std::string& plan,
                       const std::string& from, const JobLimits& limits) {
  const Redraw redraw = read_redraw(request);
  check_kept(read_plan_scene(plan));
  // Its files are the source's: only pictures are made.
  std::vector<Override> changes = redraw.changes;
  if (asks_for_files(changes))
    throw HttpError(422,
                    "drawing again makes pictures only: post the scene for files of particles and skins");
  const Scene scene = read_plan_scene(plan, changes);
  check_pictures(scene.output, limits);
  Submission submission;
  Job& job = submission.job;
  fill_idempotency(request, job);
  job.id = new_job_id();
  job.name = source.name;
  job.priority = redraw.priority;
  job.created = now_ms();
  job.points = source.points;
  job.frame_rate = source.frame_rate;
  job.progress.frames = source.progress.frames;
  submission.scene = to_json(scene);
  submission.plan = with_drawn_from(with_changed_scene(plan, changes), from);
  return submission;
}

}  // namespace lather::server
