#include "server/http/problem.h"

#include "sim/scene/value.h"

namespace lather::server {
namespace {

Value problem_value(const Problem& problem) {
  return Object{{"pointer", problem.pointer},
                {"value", problem.value},
                {"allowed", problem.allowed},
                {"message", problem.message}};
}

}  // namespace

HttpResponse HttpError::response() const {
  Object document = {
      {"type", "about:blank"}, {"title", reason_phrase(status_)}, {"status", status_}, {"detail", what()}};
  if (!problems_.empty()) {
    Array errors;
    for (const Problem& problem : problems_) errors.push_back(problem_value(problem));
    document.emplace_back("errors", std::move(errors));
  }
  for (const auto& [name, json] : members_) document.emplace_back(name, parse_json(json));
  HttpResponse response;
  response.status = status_;
  response.content_type = "application/problem+json";
  response.body = write_json(document, 2) + "\n";
  return response;
}

std::string refusal_bytes(const Refusal& refusal) {
  const HttpResponse response = HttpError(refusal.status, refusal.detail).response();
  return "HTTP/1.1 " + std::to_string(refusal.status) + ' ' + reason_phrase(refusal.status) +
         "\r\nContent-Type: " + response.content_type +
         "\r\nContent-Length: " + std::to_string(response.body.size()) +
         "\r\nX-Content-Type-Options: nosniff\r\nCache-Control: no-store\r\nConnection: close\r\n" +
         (refusal.status == 503 ? "Retry-After: 2\r\n" : "") + "\r\n" + response.body;
}

const char* reason_phrase(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 201:
      return "Created";
    case 202:
      return "Accepted";
    case 204:
      return "No Content";
    case 206:
      return "Partial Content";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 409:
      return "Conflict";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 416:
      return "Range Not Satisfiable";
    case 417:
      return "Expectation Failed";
    case 422:
      return "Unprocessable Content";
    case 431:
      return "Request Header Fields Too Large";
    case 501:
      return "Not Implemented";
    case 503:
      return "Service Unavailable";
    case 505:
      return "HTTP Version Not Supported";
    default:
      return "Internal Server Error";
  }
}

}  // namespace lather::server
