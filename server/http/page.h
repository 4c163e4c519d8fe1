#pragma once

#include <string>

#include "server/http/message.h"

namespace lather::server {

/// A file of the page, as it was built into the program; 304 to who has it. Throws HttpError 404 for any
/// other name.
[[nodiscard]] HttpResponse page_response(const HttpRequest& request, const std::string& name);

}  // namespace lather::server
