#include "tests/server/server_process.h"

#include <utility>

namespace lather::server {
namespace {

std::vector<std::string> arguments_of(const std::filesystem::path& data, std::vector<std::string> further) {
  std::vector<std::string> all = {"serve", "--port", "0", "--data", data.string(), "--threads", "1"};
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

}  // namespace

ServerProcess::ServerProcess(const std::filesystem::path& data, std::vector<std::string> further_arguments)
    : Program(arguments_of(data, std::move(further_arguments)), data.parent_path() / "server.log",
              "listening on http://"),
      port_(std::stoi(said().substr(said().rfind(':') + 1))) {}

}  // namespace lather::server
