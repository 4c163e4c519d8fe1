#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/render.h"

namespace lather::render {

/// One curve of a chart. Points that an axis cannot show (not finite, or not positive on a logarithmic axis)
/// interrupt it.
struct ChartSeries {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x
  bool dashed = false;
  bool dots = false;                                ///< a disc at each point in place of a curve
  std::optional<std::size_t> color = std::nullopt;  ///< that of the series in this place; none: its own
};

struct ChartAxis {
  std::string label;  ///< with its unit, e.g. "shear rate (1/s)"
  bool logarithmic = false;
};

struct Chart {
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<ChartSeries> series;
};

/// The chart as an SVG document of 800 x 500, legible without a style sheet or fonts of its own; text is
/// escaped. Axes hold all points; with none to show they run from 0 to 1, or from 1 to 10.
[[nodiscard]] std::string to_svg(const Chart& chart);

/// The same as a picture, twice as large. Its text is printable ASCII, and the label of the y axis lies above
/// the axis.
[[nodiscard]] Image draw_chart(const Chart& chart);

}  // namespace lather::render
