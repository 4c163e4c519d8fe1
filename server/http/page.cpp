#include "server/http/page.h"

#include <string_view>

#include "server/artifacts/digest.h"
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
  if (end == "txt") return "text/plain; charset=utf-8";
  return "application/octet-stream";
}

}  // namespace

HttpResponse page_response(const HttpRequest& request, const std::string& name) {
  for (const PageFile& file : page_files()) {
    if (name != file.name) continue;
    HttpResponse response;
    const std::string bytes(reinterpret_cast<const char*>(file.bytes), file.size);
    const std::string tag = '"' + sha256_hex(bytes) + '"';
    if (request.header("if-none-match").find(tag) != std::string::npos) {
      response.status = 304;
    } else {
      response.content_type = media_type(name);
      response.body = bytes;
    }
    response.headers.emplace_back("ETag", tag);
    response.headers.emplace_back("Cache-Control", "no-cache");
    return response;
  }
  throw HttpError(404, "there is nothing at this path");
}

}  // namespace lather::server
