#pragma once

#include <string>

#include "server/http/limits.h"
#include "server/http/message.h"
#include "server/store/store.h"

namespace lather::server {

/// A job that draws the kept particles of `source` again, from the body of a POST to /jobs/{id}/render:
/// {"look": …, "set": {"/look/…": …}, "priority": …}, all optional. `plan` is the source's, `from` the job
/// that keeps its particles. Throws HttpError, and InputError for a look that cannot be.
[[nodiscard]] Submission make_redraw(const HttpRequest& request, const Job& source, const std::string& plan,
                                     const std::string& from, const JobLimits& limits);

}  // namespace lather::server
