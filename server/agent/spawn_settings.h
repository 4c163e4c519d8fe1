#pragma once

#include <spawn.h>

#include <vector>

namespace lather::server {

/// How our child processes are spawned: never by fork alone, for a fork of a process with threads may hang in
/// OpenMP; with a clean signal mask, default actions and a process group of their own, since the server
/// blocks signals in its threads and a terminal's Ctrl-C goes to a whole group.
class SpawnSettings {
 public:
  SpawnSettings();
  ~SpawnSettings();
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

/// The environment without what leads to the store: neither our variable nor those of libpq, which may hold a
/// password. Ends with a null pointer; points into `environ`.
[[nodiscard]] std::vector<char*> environment_of_child();

}  // namespace lather::server
