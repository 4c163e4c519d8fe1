#include "render/contact_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lather::render {
namespace {

Image flat(int width, int height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), value)};
}

TEST(Reduced, KeepsAFlatColourAtAnySize) {
  const Image image = flat(37, 23, 91);
  for (const auto& [width, height] : {std::pair{37, 23}, {20, 11}, {1, 1}}) {
    const Image small = reduced(image, width, height);
    EXPECT_EQ(small.width, width);
    EXPECT_EQ(small.height, height);
    EXPECT_EQ(small.rgb, flat(width, height, 91).rgb);
  }
}

TEST(Reduced, AveragesLightNotItsEncoding) {
  Image image = flat(2, 1, 0);
  std::fill_n(image.rgb.begin(), 3, 255);
  // Half the light of white is sRGB 188, not 128.
  EXPECT_EQ(reduced(image, 1, 1).rgb, flat(1, 1, 188).rgb);
}

TEST(ContactSheet, ShowsEveryPictureOnceBesideTheOthers) {
  const std::vector<SheetRow> rows = {{"one", {{flat(64, 32, 10), 0}, {flat(64, 32, 90), 0.5}}},
                                      {"two", {{flat(64, 64, 170), 0}}}};
  const Image sheet = contact_sheet(rows, 32);
  const auto pixels_of = [&](std::uint8_t value) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i + 2 < sheet.rgb.size(); i += 3)
      count += std::all_of(sheet.rgb.begin() + static_cast<std::ptrdiff_t>(i),
                           sheet.rgb.begin() + static_cast<std::ptrdiff_t>(i) + 3,
                           [&](std::uint8_t s) { return s == value; })
                   ? 1
                   : 0;
    return count;
  };
  EXPECT_EQ(pixels_of(10), 32 * 16);
  EXPECT_EQ(pixels_of(90), 32 * 16);
  EXPECT_EQ(pixels_of(170), 32 * 32);
  EXPECT_GT(pixels_of(255), 0);  // paper
}

}  // namespace
}  // namespace lather::render
