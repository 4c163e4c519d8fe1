#include "server/http/job_changes.h"

#include <utility>
#include <vector>

#include "server/http/problem.h"
#include "server/http/submission.h"
#include "server/job/drawn_from.h"
#include "sim/plan/plan.h"
#include "sim/scene/value.h"

namespace lather::server {
namespace {

/// The one member of the body.
Value read_member(const HttpRequest& request, const std::string& name, const std::string& allowed) {
  const Value body = read_json_body(request);
  const Value* const member = body.find(name);
  if (!member || !body.object() || body.object()->size() != 1)
    throw HttpError(422, "the request cannot be used",
                    {{"", "", "{\"" + name + "\": " + allowed + "}",
                      "the body must be an object with the one member '" + name + "'"}});
  return *member;
}

}  // namespace

int read_priority(const HttpRequest& request) {
  std::vector<Problem> problems;
  int priority = 0;
  read_priority_member(read_member(request, "priority", "-100 to 100"), priority, problems);
  if (!problems.empty()) throw HttpError(422, "the request cannot be used", problems);
  return priority;
}

LongerRun make_longer(const HttpRequest& request, const std::string& plan, const JobLimits& limits) {
  const std::string duration = write_json(read_member(request, "duration", "seconds"));
  if (drawn_from(plan))
    throw HttpError(409, "the job draws another one's particles: make that one longer, then draw it again");
  const Plan before = read_plan(plan);
  const Scene scene = read_plan_scene(plan, {{"/duration", duration}});
  if (scene.last_frame() <= before.scene.last_frame())
    throw HttpError(422, "the request cannot be used",
                    {{"/duration", duration,
                      "at least " + write_json((before.scene.last_frame() + 1) / scene.frame_rate) + " s",
                      "the job has all frames of this time already"}});
  check_before_planning(scene, limits);
  const Plan after = make_plan(scene, before.choices);
  check_plan(after, limits);
  return {to_json(scene), to_json(after), after.frames, after.points};
}

}  // namespace lather::server
