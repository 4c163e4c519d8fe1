#include "tests/unit/sim/scene/scene_texts.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "sim/scene/value.h"

namespace lather::test {

std::string small_scene() {
  return R"({"lather": 1, "domain": {"min": [0, 0, 0], "max": [1, 1, 1]}, "duration": 1, "spacing": 0.05,
    "materials": [{"name": "foam", "preset": "shaving-cream"}],
    "bodies": [{"name": "ball", "material": "foam",
                "shape": {"type": "sphere", "radius": 0.2, "translate": [0.5, 0.5, 0.5]}}],
    "obstacles": [{"name": "ground", "shape": {"type": "plane", "translate": [0, 0.1, 0]}, "friction": 0.5}]})";
}

std::string with(const std::string& pointer, const std::string& json) {
  Value scene = parse_json(small_scene());
  set_at_pointer(scene, pointer, parse_json(json));
  return write_json(scene);
}

std::vector<Problem> problems_of(const std::string& text, const std::string& size,
                                 const std::vector<Override>& overrides) {
  try {
    (void)parse_scene(text, size, overrides);
  } catch (const InputError& error) {
    return error.problems();
  }
  return {};
}

std::vector<std::pair<std::string, std::string>> example_scenes() {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& entry : std::filesystem::directory_iterator(LATHER_SCENES_DIR)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    out.emplace_back(entry.path().filename().string(), text.str());
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace lather::test
