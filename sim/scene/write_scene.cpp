#include <openssl/evp.h>

#include <array>

#include "sim/scene/scene.h"
#include "sim/scene/tables.h"

namespace lather {

std::string to_json(const Scene& scene) {
  Object object = {{"lather", std::int64_t{kSceneFormat}}};
  tables::scene().write_fields(scene, object);
  return write_json(object, 2) + "\n";
}

std::string scene_hash(const Scene& scene) {
  static constexpr char kDigits[] = "0123456789abcdef";
  const std::string text = to_json(scene);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available in this machine's libcrypto.");
  }
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += {kDigits[digest[i] >> 4], kDigits[digest[i] & 15]};
  return hex;
}

}  // namespace lather
