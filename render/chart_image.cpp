#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/canvas.h"
#include "render/chart_layout.h"

namespace lather::render {
namespace {

constexpr int kZoom = 2;      // px of the picture for one of the layout
constexpr int kDot = 2;       // px, of a letter's dots
constexpr int kTitleDot = 3;  // px, of those of the title
constexpr Rgba kPaper = {255, 255, 255, 255};
constexpr Rgba kInk = {40, 40, 44, 255};
constexpr Rgba kGrid = {221, 221, 221, 255};

int px(double layout) {
  return static_cast<int>(std::lround(kZoom * layout));
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Pen {
 public:
  Pen(Image& image, const Chart& chart) : canvas_(image), scales_(chart) {}

  void axes(const Chart& chart) {
    const double bottom = kHeight - kBottom;
    const double right = kWidth - kRight;
    for (const double tick : scales_.x().ticks()) {
      const double x = scales_.left(tick);
      canvas_.fill(px(x), px(kTop), kZoom, px(bottom - kTop), kGrid);
      text_about(x, bottom + 16, number(tick));
    }
    for (const double tick : scales_.y().ticks()) {
      const double y = scales_.top(tick);
      canvas_.fill(px(kLeft), px(y), px(right - kLeft), kZoom, kGrid);
      const std::string word = number(tick);
      canvas_.text(px(kLeft - 8) - text_width(word, kDot), px(y) - kGlyphHeight * kDot / 2, word, kDot, kInk);
    }
    canvas_.fill(px(kLeft), px(bottom), px(right - kLeft), kZoom, kInk);
    canvas_.fill(px(kLeft), px(kTop), kZoom, px(bottom - kTop), kInk);
    text_about(0.5 * (kLeft + right), kHeight - 26, chart.x.label);
    canvas_.text(px(12), px(kTop - 14), chart.y.label, kDot, kInk);
    canvas_.text(px(12), px(12), chart.title, kTitleDot, kInk);
  }

  void series(const ChartSeries& s, std::size_t index) {
    const Rgba color = chart_color(s.color.value_or(index));
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!scales_.show(s.x[i], s.y[i])) continue;
      const double x = scales_.left(s.x[i]);
      const double y = scales_.top(s.y[i]);
      if (s.dots) disc(x, y, kDotRadius, color);
      if (!s.dots && i > 0 && scales_.show(s.x[i - 1], s.y[i - 1]))
        line(scales_.left(s.x[i - 1]), scales_.top(s.y[i - 1]), x, y, s.dashed, color);
    }
    const double y = legend_top(index);
    if (s.dots)
      disc(kLegendLeft + 13, y, kDotRadius, color);
    else
      line(kLegendLeft, y, kLegendLeft + 26, y, s.dashed, color);
    canvas_.text(px(kLegendLeft + 32), px(y) - kGlyphHeight * kDot / 2, s.name, kDot, kInk);
  }

 private:
  void text_about(double x, double y, const std::string& text) {
    canvas_.text(px(x) - text_width(text, kDot) / 2, px(y) - kGlyphHeight * kDot / 2, text, kDot, kInk);
  }

  void disc(double x, double y, double radius, const Rgba& color) {
    const int r = px(radius);
    for (int dy = -r; dy <= r; ++dy) {
      const int half = static_cast<int>(std::sqrt(r * r - dy * dy));
      canvas_.fill(px(x) - half, px(y) + dy, 2 * half + 1, 1, color);
    }
  }

  /// Squares of the pen's width, one beside the other along the way; a dash and a gap are as in the SVG.
  void line(double x1, double y1, double x2, double y2, bool dashed, const Rgba& color) {
    constexpr int kPen = 2 * kZoom;
    constexpr double kDash = 6;
    constexpr double kGap = 4;
    const double length = std::hypot(x2 - x1, y2 - y1);
    const int steps = std::max(1, px(length));
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      if (dashed && std::fmod(t * length, kDash + kGap) > kDash) continue;
      canvas_.fill(px(x1 + t * (x2 - x1)) - kPen / 2, px(y1 + t * (y2 - y1)) - kPen / 2, kPen, kPen, color);
    }
  }

  Canvas canvas_;
  ChartScales scales_;
};

}  // namespace

Image draw_chart(const Chart& chart) {
  Image image{px(kWidth), px(kHeight), {}};
  image.rgb.assign(static_cast<std::size_t>(3) * static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height),
                   kPaper[0]);
  Pen pen(image, chart);
  pen.axes(chart);
  for (std::size_t i = 0; i < chart.series.size(); ++i) pen.series(chart.series[i], i);
  return image;
}

}  // namespace lather::render
