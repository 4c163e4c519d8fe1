#pragma once

#include <array>
#include <cstdint>

namespace lather::render {

using Rgba = std::array<std::uint8_t, 4>;  ///< sRGB; the last is opacity, not premultiplied

}  // namespace lather::render
