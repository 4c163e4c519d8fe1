#pragma once

#include <string>

#include "server/http/message.h"

namespace lather::server {

/// A file of the page, as it was built into the program. Throws HttpError 404 for any other name.
[[nodiscard]] HttpResponse page_response(const std::string& name);

}  // namespace lather::server
