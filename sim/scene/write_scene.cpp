#include "sim/scene/scene.h"
#include "sim/scene/sha256.h"
#include "sim/scene/tables.h"

namespace lather {

std::string to_json(const Scene& scene) {
  Object object = {{"lather", std::int64_t{kSceneFormat}}};
  tables::scene().write_fields(scene, object);
  return write_json(object, 2) + "\n";
}

std::string scene_hash(const Scene& scene) {
  return sha256_hex(to_json(scene));
}

}  // namespace lather
