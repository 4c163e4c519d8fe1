#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/math/vec.h"

namespace lather {

/// What a picture shows. Read by render alone; sim carries it along.
struct Look {
  struct Camera {
    bool automatic = true;  ///< frames the domain's content over the whole motion
    Vec3 eye = Vec3::Zero();
    Vec3 target = Vec3::Zero();
    double field_of_view_deg = 35;  ///< vertical
  };
  Camera camera;
  std::string style = "points";  ///< "points", or "skin": the surface around them
  std::string color_by =
      "material";  ///< "material", "speed", "J", "plastic_strain", "plasticity", "weak", "concentration"
  std::optional<std::array<double, 2>> color_range;  ///< none: from each frame's own values
  std::string color_map = "viridis";                 ///< "viridis", "inferno", "coolwarm", "gray"
  std::vector<std::array<double, 3>>
      material_colors;  ///< sRGB in [0, 1], by material; empty: a default palette
  std::array<double, 3> background = {0.86, 0.89, 0.93};  ///< sRGB
  bool floor = true;                                      ///< draw the domain's bottom
  bool legend = true;                                     ///< when coloured by a scalar
  bool shadows = true;
  double point_scale =
      1.4;  ///< drawn radius over half the initial point distance, dimensionless; 1 leaves gaps
};

struct Output {
  int width = 1280;
  int height = 720;
  int supersampling = 2;  ///< samples per pixel and axis
  // Files of every frame beside its picture, by format.
  std::vector<std::string> particles;  ///< "ply", "vdb"
  std::vector<std::string> skin;       ///< "obj", "ply", "vdb"
  std::vector<std::string> scalars;    ///< that the particles carry beside what colours the picture
};

}  // namespace lather
