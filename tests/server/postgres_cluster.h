#pragma once

#include <sys/types.h>

#include <string>

#include "tests/server/temporary_directory.h"

namespace lather::server {

/// A PostgreSQL server of the test's own: its files in a temporary directory, reached over a unix socket
/// there, ended with the test's process.
class PostgresCluster {
 public:
  /// Throws std::runtime_error with the server's words when it does not start.
  PostgresCluster();
  ~PostgresCluster();
  PostgresCluster(const PostgresCluster&) = delete;
  PostgresCluster& operator=(const PostgresCluster&) = delete;

  /// Makes an empty database and says its URI.
  [[nodiscard]] std::string new_database();

  /// Ends every connection to its databases, as a restart of the server would.
  void drop_connections() const;

 private:
  /// Runs a program of PostgreSQL to its end; false when that was no success.
  [[nodiscard]] bool run(const std::string& program, const std::string& arguments) const;
  void start();

  TemporaryDirectory directory_;
  pid_t pid_ = -1;
  int databases_ = 0;
};

}  // namespace lather::server
