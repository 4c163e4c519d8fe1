#include "server/artifacts/digest.h"

#include <sys/random.h>

#include <cerrno>
#include <system_error>

namespace lather::server {

std::string random_token(std::size_t count) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  std::string token(count, '\0');
  std::size_t filled = 0;
  while (filled < count) {
    const ssize_t got = ::getrandom(token.data() + filled, count - filled, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::system_error(errno, std::generic_category(), "cannot read random numbers");
    filled += static_cast<std::size_t>(got);
  }
  for (char& c : token) c = kAlphabet[static_cast<unsigned char>(c) & 63];
  return token;
}

}  // namespace lather::server
