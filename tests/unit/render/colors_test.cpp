#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/colormap.h"
#include "render/legend.h"
#include "render/point_colors.h"
#include "sim/error.h"
#include "tests/unit/render/sample_frames.h"

namespace lather::render {
namespace {

/// Lightness L* of CIE 1976 (D65).
double lightness(const Rgba& color) {
  const auto linear = [](double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); };
  const double y = 0.2126 * linear(color[0] / 255.0) + 0.7152 * linear(color[1] / 255.0) +
                   0.0722 * linear(color[2] / 255.0);
  return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

TEST(ColorMap, EndsAreThePublishedColours) {
  EXPECT_EQ(ColorMap::named("viridis").at(0), (Rgba{0x44, 0x01, 0x54, 255}));
  EXPECT_EQ(ColorMap::named("viridis").at(1), (Rgba{0xfd, 0xe7, 0x25, 255}));
  EXPECT_EQ(ColorMap::named("inferno").at(0), (Rgba{0x00, 0x00, 0x04, 255}));
  EXPECT_EQ(ColorMap::named("inferno").at(1), (Rgba{0xfc, 0xff, 0xa4, 255}));
  EXPECT_EQ(ColorMap::named("coolwarm").at(0.5), (Rgba{0xdd, 0xdd, 0xdd, 255}));
}

TEST(ColorMap, ValuesOutsideTheRangeTakeTheEnds) {
  const ColorMap map = ColorMap::named("viridis");
  EXPECT_EQ(map.at(-3), map.at(0));
  EXPECT_EQ(map.at(1e30), map.at(1));
}

TEST(ColorMap, LightnessRisesAlongSequentialMaps) {
  for (const char* name : {"viridis", "inferno", "gray"}) {
    const ColorMap map = ColorMap::named(name);
    for (int i = 0; i < 32; ++i)
      EXPECT_LT(lightness(map.at(i / 32.0)), lightness(map.at((i + 1) / 32.0))) << name << i;
  }
}

TEST(ColorMap, LightnessOfTheDivergingMapPeaksInTheMiddle) {
  const ColorMap map = ColorMap::named("coolwarm");
  for (int i = 0; i < 16; ++i) {
    EXPECT_LT(lightness(map.at(i / 32.0)), lightness(map.at((i + 1) / 32.0)));
    EXPECT_LT(lightness(map.at(1 - i / 32.0)), lightness(map.at(1 - (i + 1) / 32.0)));
  }
}

TEST(ColorMap, AnUnknownNameIsRefusedWithTheKnownOnes) {
  try {
    (void)ColorMap::named("rainbow");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().front().pointer, "/look/color_map");
    EXPECT_NE(std::string(e.what()).find("viridis"), std::string::npos);
  }
}

Frame two_speeds() {
  Frame frame = empty_frame();
  add_point(frame, {0, 0.1, 0}, {3, 4, 0});
  add_point(frame, {0.1, 0.1, 0}, {0, 0, 1});
  return frame;
}

TEST(PointColors, SpeedIsTheLengthOfTheVelocity) {
  Look look;
  look.color_by = "speed";
  const PointColors result = color_points(two_speeds(), look);
  ASSERT_TRUE(result.scale);
  EXPECT_DOUBLE_EQ(result.scale->low, 1);
  EXPECT_DOUBLE_EQ(result.scale->high, 5);
  EXPECT_EQ(result.scale->unit, "m/s");
  EXPECT_EQ(result.colors[0], ColorMap::named("viridis").at(1));
  EXPECT_EQ(result.colors[1], ColorMap::named("viridis").at(0));
}

TEST(PointColors, AGivenRangeOverridesTheValues) {
  Look look;
  look.color_by = "speed";
  look.color_range = {{-1.0, 9.0}};
  EXPECT_EQ(color_points(two_speeds(), look).colors[0], ColorMap::named("viridis").at(0.6));
}

TEST(PointColors, MaterialColoursAreTheUsers) {
  Look look;
  look.material_colors = {{1.0, 0.5, 0.0}};
  EXPECT_EQ(color_points(two_speeds(), look).colors[0], (Rgba{255, 128, 0, 255}));
}

TEST(PointColors, AScalarThatTheFrameLacksIsRefusedWithThoseItHas) {
  Look look;
  look.color_by = "J";
  Frame frame = two_speeds();
  frame.points.scalars.push_back({"plastic_strain", "1", {0, 1}});
  try {
    (void)color_points(frame, look);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("plastic_strain"), std::string::npos);
  }
}

TEST(PointColors, ANonFiniteScalarIsRefused) {
  Look look;
  look.color_by = "J";
  Frame frame = two_speeds();
  frame.points.scalars.push_back({"J", "1", {1, std::numeric_limits<float>::quiet_NaN()}});
  EXPECT_THROW((void)color_points(frame, look), std::runtime_error);
}

TEST(Legend, TicksAreRoundAndInsideTheRange) {
  EXPECT_EQ(tick_values(0, 1), (std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1}));
  const std::vector<double> ticks = tick_values(0.013, 0.0871);
  ASSERT_GE(ticks.size(), 3U);
  EXPECT_NEAR(ticks.front(), 0.02, 1e-12);
  EXPECT_NEAR(ticks.back(), 0.08, 1e-12);
}

TEST(Legend, TickTextIsShortAndTellsTicksApart) {
  EXPECT_EQ(tick_text(0.6000000000000001, 0.2), "0.6");
  EXPECT_EQ(tick_text(1e-17, 0.2), "0");
  EXPECT_EQ(tick_text(-20, 10), "-20");
  EXPECT_EQ(tick_text(1.5e-6, 5e-7), "1.5e-06");
  EXPECT_EQ(tick_text(250000, 50000), "2.5e+05");
}

TEST(Legend, BarRunsFromTheLowestToTheHighestColour) {
  Image image{400, 300, std::vector<std::uint8_t>(std::size_t{3} * 400 * 300, 128)};
  draw_legend(image, {"speed", "m/s", 0, 1, "viridis"});
  const ColorMap map = ColorMap::named("viridis");
  int first = -1, last = -1, column = -1;  // rows of the bar's ends
  for (int x = 0; x < 400 && column < 0; ++x)
    for (int y = 0; y < 300; ++y) {
      const std::uint8_t* p =
          &image.rgb[3 * (static_cast<std::size_t>(y) * 400 + static_cast<std::size_t>(x))];
      const Rgba lowest = map.at(0);
      if (std::abs(p[0] - lowest[0]) + std::abs(p[1] - lowest[1]) + std::abs(p[2] - lowest[2]) < 6) {
        column = x;
        last = y;
      }
    }
  ASSERT_GE(column, 0);
  for (int y = 0; y < 300 && first < 0; ++y) {
    const std::uint8_t* p =
        &image.rgb[3 * (static_cast<std::size_t>(y) * 400 + static_cast<std::size_t>(column))];
    const Rgba highest = map.at(1);
    if (std::abs(p[0] - highest[0]) + std::abs(p[1] - highest[1]) + std::abs(p[2] - highest[2]) < 12)
      first = y;
  }
  ASSERT_GE(first, 0);
  EXPECT_NEAR(last - first, 300 * 0.42, 3);
}

}  // namespace
}  // namespace lather::render
