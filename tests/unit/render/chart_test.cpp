#include "render/chart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/chart_layout.h"

namespace lather::render {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ChartScale, HoldsAllValuesAndEndsOnTicks) {
  const std::vector<double> values = {-3.3, 0, 17};
  const ChartScale scale({&values}, false);
  for (const double v : values) {
    EXPECT_GE(scale.fraction(v), 0);
    EXPECT_LE(scale.fraction(v), 1);
  }
  EXPECT_DOUBLE_EQ(scale.fraction(scale.ticks().front()), 0);
  EXPECT_DOUBLE_EQ(scale.fraction(scale.ticks().back()), 1);
}

TEST(ChartScale, LogarithmicTicksAreDecades) {
  const std::vector<double> values = {0.02, 70, -1, 0};
  const ChartScale scale({&values}, true);
  EXPECT_EQ(scale.ticks().size(), 5U);  // 0.01 … 100
  EXPECT_NEAR(scale.fraction(1), 0.5, 1e-12);
  EXPECT_FALSE(scale.shows(0));
  EXPECT_FALSE(scale.shows(-1));
}

TEST(ChartScale, StandsWithoutValuesAndWithOne) {
  const std::vector<double> none;
  const std::vector<double> one = {4};
  for (const bool logarithmic : {false, true}) {
    EXPECT_GE(ChartScale({&none}, logarithmic).ticks().size(), 2U);
    const ChartScale scale({&one}, logarithmic);
    EXPECT_GE(scale.fraction(4), 0);
    EXPECT_LE(scale.fraction(4), 1);
  }
}

TEST(Chart, DrawsEverySeriesWithItsName) {
  Chart chart;
  chart.title = "a < b & c";
  chart.series = {{"first", {0, 1, 2}, {0, 1, 4}}, {"second", {0, 1, 2}, {4, 1, 0}, true}};
  const std::string svg = to_svg(chart);
  EXPECT_EQ(svg.compare(0, 5, "<svg "), 0);
  EXPECT_EQ(count(svg, "<path "), 4U);  // a curve and its sample in the legend, twice
  EXPECT_EQ(count(svg, ">first</text>"), 1U);
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2U);
  EXPECT_EQ(count(svg, "a &lt; b &amp; c"), 1U);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Chart, PointsThatCannotBeShownInterruptTheCurve) {
  Chart chart;
  chart.y.logarithmic = true;
  chart.series = {{"s", {0, 1, 2, 3, 4}, {1, 2, 0, std::nan(""), 10}}};
  const std::string svg = to_svg(chart);
  const std::size_t start = svg.find(" d=\"");
  const std::string path = svg.substr(start, svg.find('"', start + 4) - start);
  EXPECT_EQ(count(path, "M"), 2U) << path;
  EXPECT_EQ(count(path, "L"), 1U) << path;
}

TEST(Chart, DotsStandWhereTheirPointsAre) {
  Chart chart;
  chart.series = {{"points", {0, 1, 2}, {0, 1, 4}}};
  chart.series.front().dots = true;
  const std::string svg = to_svg(chart);
  EXPECT_EQ(count(svg, "<circle "), 4U);  // and one in the legend
  EXPECT_EQ(count(svg, "<path "), 0U);
}

/// Whether any pixel of the picture has that colour.
bool has_color(const Image& image, std::array<std::uint8_t, 3> color) {
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    if (std::equal(color.begin(), color.end(), image.rgb.begin() + static_cast<std::ptrdiff_t>(i)))
      return true;
  return false;
}

TEST(Chart, ThePictureShowsWhatTheSvgDoes) {
  Chart chart;
  chart.title = "title";
  chart.series = {{"first", {0, 1, 2}, {0, 1, 4}}, {"second", {0, 1, 2}, {4, 1, 0}, true}};
  chart.series.back().dots = true;
  const Image image = draw_chart(chart);
  EXPECT_EQ(image.width, 1600);
  EXPECT_EQ(image.height, 1000);
  EXPECT_TRUE(has_color(image, {0x00, 0x72, 0xb2}));  // the first series
  EXPECT_TRUE(has_color(image, {0xd5, 0x5e, 0x00}));  // the second
  EXPECT_FALSE(has_color(image, {0x00, 0x9e, 0x73}));
  // The middle of the disc at (1, 1): half way across the axes; a quarter of 0 … 4 up.
  const ChartScales scales(chart);
  const auto x = static_cast<std::size_t>(std::lround(2 * scales.left(1)));
  const auto y = static_cast<std::size_t>(std::lround(2 * scales.top(1)));
  EXPECT_EQ(image.rgb[3 * (y * 1600 + x)], 0xd5);
  chart.series.back().color = 0;
  EXPECT_FALSE(has_color(draw_chart(chart), {0xd5, 0x5e, 0x00})) << "it has the first one's colour now";
}

}  // namespace
}  // namespace lather::render
