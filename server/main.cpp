#include "server/command/commands.h"

int main(int argc, char** argv) {
  return lather::server::run_command_line(argc, argv);
}
