#include <cstdio>

#include "server/command/commands.h"
#include "sim/plan/plan.h"
#include "sim/scene/scene.h"
#include "sim/simulation.h"

namespace lather::server {

int version_command(bool json) {
  const char* const level = to_string(best_kernel_level());
  if (json)
    std::printf("{\"version\": \"%s\", \"kernel_level\": \"%s\"}\n", version(), level);
  else
    std::printf("lather %s (%s)\n", version(), level);
  return 0;
}

int schema_command() {
  std::printf("%s\n", scene_schema().c_str());
  return 0;
}

int reference_command() {
  std::printf("%s\n", scene_reference().c_str());
  return 0;
}

}  // namespace lather::server
