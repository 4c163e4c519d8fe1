#include "server/http/submission.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "server/artifacts/digest.h"
#include "server/http/problem.h"
#include "server/run/budget.h"

namespace lather::server {
namespace {

constexpr int kMostPriority = 100;
constexpr std::size_t kLongestKey = 128;
constexpr std::size_t kLongestShown = 80;  // bytes of a value in a message

struct Envelope {
  std::string scene;
  std::string size;
  std::vector<Override> overrides;
  int priority = 0;
  bool enveloped = false;
};

void require_json(const HttpRequest& request) {
  const std::string type = request.header("content-type");
  const std::string media = type.substr(0, type.find_first_of("; "));
  if (media != "application/json")
    throw HttpError(415, "the body must be JSON: send 'Content-Type: application/json'");
}

Value parse_body(const std::string& body) {
  try {
    return parse_json(body);
  } catch (const InputError& error) {
    throw HttpError(400, "the body is not usable JSON", error.problems());
  }
}

/// Cut short, but not inside a UTF-8 character.
std::string shortened(const Value& value) {
  std::string text = write_json(value);
  if (text.size() <= kLongestShown) return text;
  std::size_t end = kLongestShown;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

Problem wrong(const std::string& pointer, const Value& value, std::string allowed, std::string message) {
  return {pointer, shortened(value), std::move(allowed), std::move(message)};
}

class EnvelopeReader {
 public:
  Envelope read(const Value& root) {
    if (!root.object() || root.object()->empty())
      refuse({"", shortened(root), "a scene, or {\"scene\": …}", "the body is no scene"});
    if (root.find("lather")) {
      envelope_.scene = write_json(root);
      return std::move(envelope_);
    }
    envelope_.enveloped = true;
    for (const auto& [key, value] : *root.object()) read_member(key, value);
    if (!root.find("scene"))
      problems_.push_back(
          {"/scene", "", "an object", "there is no scene (a bare one starts with \"lather\": 1)"});
    if (!problems_.empty()) throw HttpError(422, "the request cannot be used", problems_);
    return std::move(envelope_);
  }

 private:
  [[noreturn]] static void refuse(Problem problem) {
    throw HttpError(422, "the request cannot be used", {std::move(problem)});
  }

  void read_member(const std::string& key, const Value& value) {
    if (key == "scene") {
      read_scene(value);
    } else if (key == "size") {
      read_size(value);
    } else if (key == "set") {
      read_override_members(value, envelope_.overrides, problems_);
    } else if (key == "priority") {
      read_priority_member(value, envelope_.priority, problems_);
    } else {
      problems_.push_back(wrong(pointer_token(key), value, "scene, size, set, priority",
                                "'" + key + "' is no member of a request"));
    }
  }

  void read_scene(const Value& value) {
    if (!value.object())
      problems_.push_back(wrong("/scene", value, "an object", "the scene must be an object"));
    envelope_.scene = write_json(value);
  }

  void read_size(const Value& value) {
    if (value.text())
      envelope_.size = *value.text();
    else
      problems_.push_back(
          wrong("/size", value, "the name of one of the scene's sizes", "size must be a string"));
  }

  Envelope envelope_;
  std::vector<Problem> problems_;
};

/// The scene's own pointers start at the scene; in an envelope that is one step further down.
std::vector<Problem> below_scene(std::vector<Problem> problems, bool enveloped) {
  if (enveloped)
    for (Problem& problem : problems) problem.pointer = "/scene" + problem.pointer;
  return problems;
}

Plan plan_envelope(const Envelope& envelope, const JobLimits& limits) {
  try {
    const Scene scene = parse_scene(envelope.scene, envelope.size, envelope.overrides);
    check_before_planning(scene, limits);
    Plan plan = make_plan(scene);
    check_plan(plan, limits);
    if (!scene.budget) return plan;
    plan = plan_in_budget(scene, 0, estimate_drawing(scene.output));
    check_plan(plan, limits);
    return plan;
  } catch (const InputError& error) {
    throw HttpError(422, "the scene cannot be used", below_scene(error.problems(), envelope.enveloped));
  }
}

}  // namespace

Value read_json_body(const HttpRequest& request) {
  require_json(request);
  return parse_body(request.body);
}

void read_override_members(const Value& set, std::vector<Override>& overrides,
                           std::vector<Problem>& problems) {
  if (!set.object()) {
    problems.push_back(wrong("/set", set, "{\"/json/pointer\": value}", "set must be an object"));
    return;
  }
  for (const auto& [pointer, replacement] : *set.object())
    overrides.push_back({pointer, write_json(replacement)});
}

void read_priority_member(const Value& value, int& priority, std::vector<Problem>& problems) {
  const auto* const whole = std::get_if<std::int64_t>(&value.data);
  if (whole && *whole >= -kMostPriority && *whole <= kMostPriority)
    priority = static_cast<int>(*whole);
  else
    problems.push_back(
        wrong("/priority", value, "a whole number from -100 to 100", "priority is out of range"));
}

void fill_idempotency(const HttpRequest& request, Job& job) {
  const std::string key = request.header("idempotency-key");
  const bool plain = std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (key.size() > kLongestKey || !plain)
    throw HttpError(400, "Idempotency-Key must be at most 128 printable characters without spaces");
  job.idempotency_key = key;
  job.request_digest = sha256_hex(request.path + '\n' + request.body);
}

PostedScene read_posted_scene(const HttpRequest& request, const JobLimits& limits) {
  const Envelope envelope = EnvelopeReader().read(read_json_body(request));
  return {plan_envelope(envelope, limits), envelope.priority};
}

Submission make_submission(const HttpRequest& request, const PostedScene& posted) {
  Submission submission;
  Job& job = submission.job;
  fill_idempotency(request, job);
  job.id = new_job_id();
  job.name = posted.plan.scene.name;
  job.priority = posted.priority;
  job.created = now_ms();
  job.points = posted.plan.points;
  job.frame_rate = posted.plan.scene.frame_rate;
  job.progress.frames = posted.plan.frames;
  submission.scene = to_json(posted.plan.scene);
  submission.plan = to_json(posted.plan);
  return submission;
}

}  // namespace lather::server
