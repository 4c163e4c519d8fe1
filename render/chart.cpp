#include "render/chart.h"

#include <cstdio>

#include "render/chart_scale.h"

namespace lather::render {
namespace {

// px
constexpr double kWidth = 800;
constexpr double kHeight = 500;
constexpr double kLeft = 90;
constexpr double kRight = 210;  // with the legend
constexpr double kTop = 50;
constexpr double kBottom = 70;

// Okabe and Ito's colours, which colour-blind people can tell apart.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#e69f00", "#56b4e9", "#000000"};
constexpr std::size_t kColorCount = sizeof kColors / sizeof *kColors;

struct Scales {
  ChartScale x;
  ChartScale y;

  [[nodiscard]] double left(double value) const {
    return kLeft + x.fraction(value) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] double top(double value) const {
    return kHeight - kBottom - y.fraction(value) * (kHeight - kTop - kBottom);
  }
};

Scales scales_of(const Chart& chart) {
  std::vector<const std::vector<double>*> x;
  std::vector<const std::vector<double>*> y;
  for (const ChartSeries& s : chart.series) {
    x.push_back(&s.x);
    y.push_back(&s.y);
  }
  return {ChartScale(x, chart.x.logarithmic), ChartScale(y, chart.y.logarithmic)};
}

std::string number(double value, const char* format = "%.2f") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more = {}) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" + more + ">" +
         escaped(text) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& stroke) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
         number(y2) + "\" stroke=\"" + stroke + "\"/>\n";
}

std::string axes(const Chart& chart, const Scales& scales) {
  const double bottom = kHeight - kBottom;
  const double right = kWidth - kRight;
  std::string out;
  for (const double tick : scales.x.ticks()) {
    const double x = scales.left(tick);
    out += line(x, kTop, x, bottom, "#ddd") + text_at(x, bottom + 20, "middle", number(tick, "%.6g"));
  }
  for (const double tick : scales.y.ticks()) {
    const double y = scales.top(tick);
    out += line(kLeft, y, right, y, "#ddd") + text_at(kLeft - 8, y + 4, "end", number(tick, "%.6g"));
  }
  out += line(kLeft, bottom, right, bottom, "#333") + line(kLeft, kTop, kLeft, bottom, "#333");
  const double middle = 0.5 * (kTop + bottom);
  out += text_at(0.5 * (kLeft + right), kHeight - 22, "middle", chart.x.label);
  out += text_at(22, middle, "middle", chart.y.label, " transform=\"rotate(-90 22 " + number(middle) + ")\"");
  return out;
}

/// "M x y L x y …", begun anew after each point that cannot be shown.
std::string path_of(const ChartSeries& series, const Scales& scales) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool shown = scales.x.shows(series.x[i]) && scales.y.shows(series.y[i]);
    if (shown)
      path += (pen_down ? "L" : "M") + number(scales.left(series.x[i])) + " " +
              number(scales.top(series.y[i])) + " ";
    pen_down = shown;
  }
  return path;
}

std::string curve(const ChartSeries& series, std::size_t index, const Scales& scales) {
  const std::string stroke = std::string(" stroke=\"") + kColors[index % kColorCount] +
                             "\" stroke-width=\"2\"" + (series.dashed ? " stroke-dasharray=\"6 4\"" : "");
  const double x = kWidth - kRight + 15;
  const double y = kTop + 10 + 22 * static_cast<double>(index);
  return "<path fill=\"none\"" + stroke + " d=\"" + path_of(series, scales) + "\"/>\n" +
         "<path fill=\"none\"" + stroke + " d=\"M" + number(x) + " " + number(y) + " h 26\"/>\n" +
         text_at(x + 32, y + 4, "start", series.name);
}

}  // namespace

std::string to_svg(const Chart& chart) {
  const Scales scales = scales_of(chart);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(kWidth, "%.0f") +
                    "\" height=\"" + number(kHeight, "%.0f") + "\" viewBox=\"0 0 " + number(kWidth, "%.0f") +
                    " " + number(kHeight, "%.0f") + "\" font-family=\"sans-serif\" font-size=\"13\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  out += text_at(kLeft, 28, "start", chart.title, " font-size=\"16\"");
  out += axes(chart, scales);
  for (std::size_t i = 0; i < chart.series.size(); ++i) out += curve(chart.series[i], i, scales);
  return out + "</svg>\n";
}

}  // namespace lather::render
