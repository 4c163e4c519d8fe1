#pragma once

#include <string>

namespace lather::testing_support {

/// Keys of a material by law, without its name.
inline const std::string kJelly =
    R"("model": "neo-hookean", "density": 1000, "youngs_modulus": 5e3, "poisson_ratio": 0.4)";
inline const std::string kSand =
    R"("model": "drucker-prager", "density": 1600, "youngs_modulus": 1e6, "poisson_ratio": 0.3,
       "friction_angle_deg": 30)";
inline const std::string kSnow =
    R"("model": "snow", "density": 400, "youngs_modulus": 1.4e5, "poisson_ratio": 0.2)";
inline const std::string kWater = R"("model": "liquid", "density": 1000, "bulk_modulus": 1e5)";

/// A scene's text with its first "DIM" replaced by the number of dimensions.
[[nodiscard]] std::string with_dimension(std::string json, int dimension);

/// A scene of one body of every law, close enough to touch at once, and a peg in their way, at 50 mm for 0.04
/// s. `foam`: further keys of the foam; `extra`: of the scene.
[[nodiscard]] std::string all_laws(int dimension, const std::string& foam, const std::string& extra);

}  // namespace lather::testing_support
