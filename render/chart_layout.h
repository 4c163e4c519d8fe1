#pragma once

#include "render/chart.h"
#include "render/chart_scale.h"
#include "render/rgba.h"

/// Where things stand on a chart of 800 x 500, whatever it is drawn as. px.
namespace lather::render {

inline constexpr double kWidth = 800;
inline constexpr double kHeight = 500;
inline constexpr double kLeft = 90;
inline constexpr double kRight = 210;  ///< with the legend
inline constexpr double kTop = 50;
inline constexpr double kBottom = 70;
inline constexpr double kLegendLeft = kWidth - kRight + 15;
inline constexpr double kDotRadius = 4;

/// The middle of a legend's line.
[[nodiscard]] double legend_top(std::size_t series);

/// Okabe and Ito's colours, which colour-blind people can tell apart.
[[nodiscard]] Rgba chart_color(std::size_t series);

class ChartScales {
 public:
  explicit ChartScales(const Chart& chart);
  [[nodiscard]] const ChartScale& x() const { return x_; }
  [[nodiscard]] const ChartScale& y() const { return y_; }
  [[nodiscard]] bool show(double x, double y) const { return x_.shows(x) && y_.shows(y); }
  [[nodiscard]] double left(double value) const;
  [[nodiscard]] double top(double value) const;

 private:
  ChartScale x_;
  ChartScale y_;
};

}  // namespace lather::render
