#pragma once

#include <string_view>

#include "sim/frame.h"
#include "sim/scenery.h"

namespace lather {

/// The frame that particles_ply() wrote, whole again but for its skins: the points from the bytes, all else
/// from the scene. Throws std::runtime_error where the bytes are not of a frame of this scene.
[[nodiscard]] Frame read_kept_frame(std::string_view particles_ply, const Scenery& scenery);

}  // namespace lather
