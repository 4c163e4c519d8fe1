#include <unistd.h>

#include <cstdlib>

#include "server/command/commands.h"

namespace {

/// Waiting OpenMP threads must sleep, not spin: with drawing, other jobs or other programs on the same cores,
/// spinning at every barrier of a step made a run fifteen times slower (measured with two busy loops on two
/// cores). libgomp reads the policy before main() starts, so the program sets it and starts itself once more;
/// runners inherit it.
void sleep_while_waiting(char** argv) {
  constexpr int kKeepTheUsersChoice = 0;
  if (std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  setenv("OMP_WAIT_POLICY", "passive", kKeepTheUsersChoice);
  execv("/proc/self/exe", argv);
  // Without /proc it goes on as it is, only slower.
}

}  // namespace

int main(int argc, char** argv) {
  sleep_while_waiting(argv);
  return lather::server::run_command_line(argc, argv);
}
