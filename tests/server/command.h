#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/server/blackbox.h"

namespace lather::server {

/// Runs the real program's commands in a directory of their own.
class Command : public Blackbox {
 protected:
  /// The exit code; what it printed, both streams, is in said().
  int run(const std::string& arguments) {
    const std::string line = std::string(LATHER_PROGRAM) + ' ' + arguments + " > " +
                             (directory_.path() / "said").string() + " 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string said() const { return read(directory_.path() / "said"); }
  static std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
};

}  // namespace lather::server
