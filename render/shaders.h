#pragma once

#include <string>

/// GLSL 3.30 sources by pass; each is whole, with its version line.
namespace lather::render::shaders {

struct Stages {
  std::string vertex;
  std::string fragment;
};

[[nodiscard]] Stages mesh();          ///< obstacles into the geometry buffer
[[nodiscard]] Stages ground();        ///< floor of 3D scenes, backdrop of 2D ones, into the geometry buffer
[[nodiscard]] Stages points();        ///< sphere impostors into the geometry buffer
[[nodiscard]] Stages mesh_shadow();   ///< depth from the key light
[[nodiscard]] Stages point_shadow();  ///< depth from the key light
[[nodiscard]] Stages occlusion();     ///< screen-space ambient occlusion
[[nodiscard]] Stages blur_occlusion();
[[nodiscard]] Stages composite();  ///< lights, tone map, averages the samples of a pixel, encodes as sRGB

}  // namespace lather::render::shaders
