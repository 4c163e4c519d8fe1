#pragma once

#include "render/camera.h"
#include "sim/frame.h"
#include "sim/scene/look.h"

/// Everything about one picture that is decided before a pass runs.
namespace lather::render {

struct Lights {
  Vec3 key, fill, rim;  ///< unit, towards the light, world space
};

struct Shot {
  View view;
  Lights lights;
  Mat4 shadow_clip_from_world;  ///< parallel projection along the key light around the content
  double shadow_side = 1;       ///< m, width of what the shadow map covers
  double point_radius = 0;      ///< as drawn, m
  Box3 content;                 ///< points and obstacles
  bool flat = false;            ///< a 2D scene
  bool ground = false;          ///< floor (3D, seen from above) or backdrop (2D)
  double floor_fade = 1;        ///< m from floor_center to where the floor has faded away
  Vec3 floor_center = Vec3::Zero();
  bool shadows = false;
};

/// `camera` is the resolved one (not automatic). Throws std::runtime_error when content is not finite.
[[nodiscard]] Shot make_shot(const Frame& frame, const Look& look, const Look::Camera& camera, double aspect);

/// Throws std::runtime_error naming the first point or obstacle whose place is not finite.
void check_finite(const Frame& frame);

}  // namespace lather::render
