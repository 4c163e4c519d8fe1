#include "server/http/client.h"

#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>

#include "sim/error.h"

namespace lather::server {
namespace {

constexpr int kDefaultPort = 80;
constexpr int kPatienceSeconds = 60;

struct Address {
  std::string host;
  int port = kDefaultPort;
  std::string prefix;
};

Address parse_url(const std::string& url) {
  static constexpr std::string_view kScheme = "http://";
  const InputError error({{"", url, "http://HOST:PORT", "this is no address of a server"}});
  if (url.compare(0, kScheme.size(), kScheme) != 0) throw error;
  const std::size_t slash = std::min(url.find('/', kScheme.size()), url.size());
  const std::string authority = url.substr(kScheme.size(), slash - kScheme.size());
  Address address;
  address.prefix = url.substr(slash);
  while (!address.prefix.empty() && address.prefix.back() == '/') address.prefix.pop_back();
  const std::size_t colon = authority.rfind(':');
  const std::size_t bracket = authority.rfind(']');
  const bool has_port = colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  address.host = authority.substr(0, has_port ? colon : authority.size());
  if (address.host.size() > 2 && address.host.front() == '[')
    address.host = address.host.substr(1, address.host.size() - 2);
  if (has_port) {
    const char* const end = authority.data() + authority.size();
    const auto [stop, bad] = std::from_chars(authority.data() + colon + 1, end, address.port);
    if (bad != std::errc{} || stop != end || address.port < 1 || address.port > 65535) throw error;
  }
  if (address.host.empty()) throw error;
  return address;
}

}  // namespace

class ApiClient::Connection {
 public:
  explicit Connection(const Address& address)
      : client_(address.host, address.port),
        place_(address.host + " port " + std::to_string(address.port)),
        prefix_(address.prefix) {
    client_.set_keep_alive(true);
    client_.set_connection_timeout(5);
    client_.set_read_timeout(kPatienceSeconds);
    client_.set_write_timeout(kPatienceSeconds);
  }

  Answer get(const std::string& path) { return answer(client_.Get(prefix_ + path)); }

  Answer post(const std::string& path, const std::string& body, const std::string& key) {
    httplib::Headers headers;
    if (!key.empty()) headers.emplace("Idempotency-Key", key);
    return answer(client_.Post(prefix_ + path, headers, body, "application/json"));
  }

 private:
  Answer answer(const httplib::Result& result) const {
    if (!result)
      throw std::runtime_error("no answer from " + place_ + " (" + httplib::to_string(result.error()) +
                               "): is the server running there?");
    return {result->status, result->body};
  }

  httplib::Client client_;
  const std::string place_;
  const std::string prefix_;
};

ApiClient::ApiClient(const std::string& url) : connection_(std::make_unique<Connection>(parse_url(url))) {}

ApiClient::~ApiClient() = default;

ApiClient::Answer ApiClient::get(const std::string& path) {
  return connection_->get(path);
}

ApiClient::Answer ApiClient::post(const std::string& path, const std::string& body,
                                  const std::string& idempotency_key) {
  return connection_->post(path, body, idempotency_key);
}

}  // namespace lather::server
