#include "render/colormap.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sim/error.h"

namespace lather::render {
namespace {

// Samples of the published maps: viridis and inferno by Smith and van der Walt (CC0), coolwarm by Moreland
// 2009.
constexpr std::array<std::uint32_t, 9> kViridis = {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c,
                                                   0x28ae80, 0x5ec962, 0xaddc30, 0xfde725};
constexpr std::array<std::uint32_t, 9> kInferno = {0x000004, 0x210c4a, 0x56106e, 0x89226a, 0xbb3754,
                                                   0xe35932, 0xf98c0a, 0xf9c932, 0xfcffa4};
constexpr std::array<std::uint32_t, 9> kCoolwarm = {0x3b4cc0, 0x6282ea, 0x8db0fe, 0xb8d0f9, 0xdddddd,
                                                    0xf5c4ad, 0xf49a7b, 0xde604d, 0xb40426};
constexpr std::array<std::uint32_t, 9> kGray = {0x111111, 0x2e2e2e, 0x4b4b4b, 0x686868, 0x858585,
                                                0xa2a2a2, 0xbfbfbf, 0xdcdcdc, 0xf9f9f9};

double channel(std::uint32_t rgb, int index) {
  return static_cast<double>((rgb >> (16 - 8 * index)) & 0xff);
}

}  // namespace

ColorMap ColorMap::named(std::string_view name) {
  if (name == "viridis") return ColorMap(kViridis);
  if (name == "inferno") return ColorMap(kInferno);
  if (name == "coolwarm") return ColorMap(kCoolwarm);
  if (name == "gray") return ColorMap(kGray);
  Problem problem;
  problem.pointer = "/look/color_map";
  problem.value = '"' + std::string(name) + '"';
  problem.allowed = "viridis, inferno, coolwarm, gray";
  problem.message = "No such colour map; choose one of those allowed.";
  throw InputError({problem});
}

Rgba ColorMap::at(double t) const {
  const double position = std::clamp(t, 0.0, 1.0) * static_cast<double>(table_->size() - 1);
  const auto left = std::min(static_cast<std::size_t>(position), table_->size() - 2);
  const double blend = position - static_cast<double>(left);
  Rgba color = {0, 0, 0, 255};
  for (int i = 0; i < 3; ++i)
    color[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
        std::lround(channel((*table_)[left], i) * (1 - blend) + channel((*table_)[left + 1], i) * blend));
  return color;
}

}  // namespace lather::render
