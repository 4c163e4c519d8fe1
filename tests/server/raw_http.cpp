#include "tests/server/raw_http.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>

namespace lather::server {
namespace {

std::string join_chunks(const std::string& body) {
  std::string joined;
  std::size_t at = 0;
  while (true) {
    const std::size_t end = body.find("\r\n", at);
    if (end == std::string::npos) throw std::runtime_error("a chunked body was cut short");
    const std::size_t size = std::stoul(body.substr(at, end - at), nullptr, 16);
    if (size == 0) return joined;
    joined += body.substr(end + 2, size);
    at = end + 2 + size + 2;
  }
}

RawResponse parse(const std::string& bytes) {
  RawResponse response;
  const std::size_t end = bytes.find("\r\n\r\n");
  if (bytes.compare(0, 7, "HTTP/1.") != 0 || end == std::string::npos) return response;
  response.status = std::stoi(bytes.substr(9, 3));
  std::size_t at = bytes.find("\r\n") + 2;
  while (at < end + 2) {
    const std::size_t line_end = bytes.find("\r\n", at);
    const std::size_t colon = bytes.find(": ", at);
    std::string name = bytes.substr(at, colon - at);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    response.headers[name] = bytes.substr(colon + 2, line_end - colon - 2);
    at = line_end + 2;
  }
  response.body = bytes.substr(end + 4);
  if (response.headers.count("transfer-encoding") != 0) response.body = join_chunks(response.body);
  return response;
}

void send_all(int fd, const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t count = ::send(fd, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;  // refused early: the answer says why
    sent += static_cast<std::size_t>(count);
  }
}

std::string receive_all(int fd, std::chrono::seconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  std::string bytes;
  char chunk[65536];
  while (true) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd readable = {fd, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&readable, 1, static_cast<int>(left.count())) <= 0) return bytes;
    const ssize_t got = ::recv(fd, chunk, sizeof chunk, 0);
    if (got <= 0) return bytes;
    bytes.append(chunk, static_cast<std::size_t>(got));
  }
}

}  // namespace

int connect_to(int port) {
  const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd);
    throw std::runtime_error("cannot connect to port " + std::to_string(port));
  }
  return fd;
}

RawResponse exchange(int port, const std::string& bytes, std::chrono::seconds patience) {
  const int fd = connect_to(port);
  send_all(fd, bytes);
  const std::string answer = receive_all(fd, patience);
  ::close(fd);
  return parse(answer);
}

RawResponse request(int port, const std::string& method, const std::string& path, const std::string& body,
                    const std::string& header_lines) {
  std::string head =
      method + ' ' + path + " HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n" + header_lines;
  if (method == "POST") head += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  if (!body.empty() && header_lines.find("Content-Type") == std::string::npos)
    head += "Content-Type: application/json\r\n";
  return exchange(port, head + "\r\n" + body);
}

}  // namespace lather::server
