#include "render/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/chart_scale.h"

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

}  // namespace
}  // namespace lather::render
