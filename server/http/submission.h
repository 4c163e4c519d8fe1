#pragma once

#include <string>

#include "server/http/limits.h"
#include "server/http/message.h"
#include "server/store/store.h"
#include "sim/plan/plan.h"
#include "sim/scene/value.h"

namespace lather::server {

/// What a POST of a job or a plan asks for: a bare scene (it has the key "lather"), or an envelope
/// {"scene": …, "size": "preview", "set": {"/json/pointer": value}, "priority": 0}.
struct PostedScene {
  Plan plan;
  int priority = 0;  ///< -100 … 100
};

/// Reads and plans it. Throws HttpError: 415 unless the body is JSON by its type, 400 when it is no JSON, 422
/// with every problem found when the scene is invalid or beyond `limits`.
[[nodiscard]] PostedScene read_posted_scene(const HttpRequest& request, const JobLimits& limits);

// Parts that requests share. Problems are appended to `problems`.
/// Throws HttpError: 415 unless the body is JSON by its type, 400 when it is no JSON.
[[nodiscard]] Value read_json_body(const HttpRequest& request);
/// The member "set": {"/json/pointer": value}.
void read_override_members(const Value& set, std::vector<Override>& overrides,
                           std::vector<Problem>& problems);
/// The member "priority": -100 … 100.
void read_priority_member(const Value& value, int& priority, std::vector<Problem>& problems);
/// Key and digest of the request, into `job`. Throws HttpError 400 for a malformed key.
void fill_idempotency(const HttpRequest& request, Job& job);

/// A new queued job for it, with the request's idempotency key. Throws HttpError 400 for a malformed key.
[[nodiscard]] Submission make_submission(const HttpRequest& request, const PostedScene& posted);

}  // namespace lather::server
