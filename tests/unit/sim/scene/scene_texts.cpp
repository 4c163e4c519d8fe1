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

std::string mlsrk_scene(const Changes& changes) {
  Value scene = parse_json(R"({"lather": 1, "solver": "mlsrk", "domain": {"min": [0, 0, 0], "max": [1, 1, 1]},
    "duration": 1, "spacing": 0.05,
    "materials": [
      {"name": "foam", "density": 100, "bulk_modulus": 1e5, "shear_modulus": 1e3, "yield_stress": 30},
      {"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 5e3, "poisson_ratio": 0.4,
       "viscosity": 0.5, "bulk_viscosity": 0.25},
      {"name": "sand", "model": "drucker-prager", "density": 1600, "youngs_modulus": 1e6, "poisson_ratio": 0,
       "viscosity": 2, "bulk_viscosity": 3, "friction_angle_deg": 30, "friction_match": "plane-strain",
       "cohesion": 0.01, "hardening": 5},
      {"name": "snow", "model": "snow", "density": 400, "youngs_modulus": 1.4e5, "poisson_ratio": 0.2,
       "critical_compression": 0.019, "critical_stretch": 0.005, "hardening": 7},
      {"name": "water", "model": "liquid", "density": 1000, "bulk_modulus": 1e5, "exponent": 3, "viscosity": 0.1,
       "bulk_viscosity": 0.2}],
    "bodies": [{"name": "ball", "material": "jelly",
                "shape": {"type": "sphere", "radius": 0.2, "translate": [0.5, 0.5, 0.5]}}]})");
  for (const auto& [pointer, json] : changes) set_at_pointer(scene, pointer, parse_json(json));
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
