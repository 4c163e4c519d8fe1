#pragma once

#include <string>

#include "server/http/limits.h"
#include "server/http/message.h"
#include "server/store/store.h"

/// The bodies of requests that change a job.
namespace lather::server {

/// {"priority": -100 … 100}. Throws HttpError.
[[nodiscard]] int read_priority(const HttpRequest& request);

/// {"duration": s}, longer than that of `plan`, so that at least one frame is added: the scene and the plan
/// of the longer run. Throws HttpError, 409 for a plan that draws another job's particles again.
[[nodiscard]] LongerRun make_longer(const HttpRequest& request, const std::string& plan,
                                    const JobLimits& limits);

}  // namespace lather::server
