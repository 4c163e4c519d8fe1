#include "tests/support/law_scenes.h"

namespace lather::testing_support {

std::string with_dimension(std::string json, int dimension) {
  json.replace(json.find("DIM"), 3, std::to_string(dimension));
  return json;
}

std::string all_laws(int dimension, const std::string& foam, const std::string& extra) {
  return with_dimension(R"({"lather": 1, "name": "all laws", "dimension": DIM,
    "domain": {"min": [0, 0, 0], "max": [1.2, 0.8, 0.4], "periodic": [true, false, false]},
    "duration": 0.04, "frame_rate": 100, "spacing": 0.05, "jitter": 0.1, "seed": 7,
    "materials": [
      {"name": "foam", "preset": "shaving-cream")" +
                            foam + R"(},
      {"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e5, "poisson_ratio": 0.3,
       "viscosity": 5},
      {"name": "sand", "model": "drucker-prager", "density": 1500, "youngs_modulus": 1e5, "poisson_ratio": 0.2,
       "friction_angle_deg": 30},
      {"name": "snow", "model": "snow", "density": 400, "youngs_modulus": 1e5, "poisson_ratio": 0.2},
      {"name": "water", "model": "liquid", "density": 1000, "bulk_modulus": 1e5, "viscosity": 1}],
    "bodies": [
      {"name": "foam", "material": "foam",
       "shape": {"type": "box", "size": [0.2, 0.2, 0.5], "translate": [0.1, 0.15, 0.2]}},
      {"name": "jelly", "material": "jelly", "velocity": [-1, -1, 0],
       "shape": {"type": "box", "size": [0.2, 0.2, 0.5], "translate": [0.33, 0.2, 0.2]}},
      {"name": "sand", "material": "sand",
       "shape": {"type": "box", "size": [0.2, 0.3, 0.5], "translate": [0.55, 0.15, 0.2]}},
      {"name": "snow", "material": "snow", "velocity": [-2, 0, 0],
       "shape": {"type": "sphere", "radius": 0.12, "translate": [0.8, 0.15, 0.1]}},
      {"name": "water", "material": "water",
       "shape": {"type": "box", "size": [0.2, 0.3, 0.5], "translate": [1.03, 0.16, 0.2]}}],
    "obstacles": [{"name": "peg", "shape": {"type": "sphere", "radius": 0.06, "translate": [0.4, 0.04, 0.2]},
                   "friction": 0.3}],
    )" + extra + "}",
                        dimension);
}

}  // namespace lather::testing_support
