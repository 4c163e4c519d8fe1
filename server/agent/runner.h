#pragma once

namespace lather::server {

/// The runner's life, in its own process: takes the order from `fd`, runs it, sends events back and ends. It
/// ends at once when the other end of `fd` closes, and knows no store and no network. Returns the exit code.
int runner_main(int fd);

}  // namespace lather::server
