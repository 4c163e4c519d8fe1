#include "server/http/page.h"

#include <string_view>

#include "server/http/page_files.h"
#include "server/http/problem.h"

namespace lather::server {
namespace {

/// By the name's end; a fixed table, for the type decides whether a browser runs what it gets.
const char* media_type(std::string_view name) {
  const std::string_view end = name.substr(name.rfind('.') + 1);
  if (end == "html") return "text/html; charset=utf-8";
  if (end == "js") return "text/javascript; charset=utf-8";
  if (end == "css") return "text/css; charset=utf-8";
  if (end == "svg") return "image/svg+xml";
  return "application/octet-stream";
}

}  // namespace

HttpResponse page_response(const std::string& name) {
  for (const PageFile& file : page_files()) {
    if (name != file.name) continue;
    HttpResponse response;
    response.content_type = media_type(name);
    response.body = std::string(reinterpret_cast<const char*>(file.bytes), file.size);
    response.headers.emplace_back("Cache-Control", "no-cache");
    return response;
  }
  throw HttpError(404, "there is nothing at this path");
}

}  // namespace lather::server
