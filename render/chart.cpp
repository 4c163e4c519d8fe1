#include "render/chart.h"

#include <cstdio>

#include "render/chart_layout.h"

namespace lather::render {
namespace {

std::string number(double value, const char* format = "%.2f") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string hex(const Rgba& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", color[0], color[1], color[2]);
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

std::string axes(const Chart& chart, const ChartScales& scales) {
  const double bottom = kHeight - kBottom;
  const double right = kWidth - kRight;
  std::string out;
  for (const double tick : scales.x().ticks()) {
    const double x = scales.left(tick);
    out += line(x, kTop, x, bottom, "#ddd") + text_at(x, bottom + 20, "middle", number(tick, "%.6g"));
  }
  for (const double tick : scales.y().ticks()) {
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
std::string path_of(const ChartSeries& series, const ChartScales& scales) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool shown = scales.show(series.x[i], series.y[i]);
    if (shown)
      path += (pen_down ? "L" : "M") + number(scales.left(series.x[i])) + " " +
              number(scales.top(series.y[i])) + " ";
    pen_down = shown;
  }
  return path;
}

/// A disc at each point that can be shown.
std::string dots(const ChartSeries& series, const std::string& color, const ChartScales& scales) {
  std::string out;
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (scales.show(series.x[i], series.y[i]))
      out += "<circle cx=\"" + number(scales.left(series.x[i])) + "\" cy=\"" +
             number(scales.top(series.y[i])) + "\" r=\"" + number(kDotRadius) + "\" fill=\"" + color +
             "\"/>\n";
  return out;
}

std::string curve(const ChartSeries& series, std::size_t index, const ChartScales& scales) {
  const std::string color = hex(chart_color(series.color.value_or(index)));
  const std::string stroke =
      " stroke=\"" + color + "\" stroke-width=\"2\"" + (series.dashed ? " stroke-dasharray=\"6 4\"" : "");
  const double x = kLegendLeft;
  const double y = legend_top(index);
  if (series.dots)
    return dots(series, color, scales) + "<circle cx=\"" + number(x + 13) + "\" cy=\"" + number(y) +
           "\" r=\"" + number(kDotRadius) + "\" fill=\"" + color + "\"/>\n" +
           text_at(x + 32, y + 4, "start", series.name);
  return "<path fill=\"none\"" + stroke + " d=\"" + path_of(series, scales) + "\"/>\n" +
         "<path fill=\"none\"" + stroke + " d=\"M" + number(x) + " " + number(y) + " h 26\"/>\n" +
         text_at(x + 32, y + 4, "start", series.name);
}

}  // namespace

std::string to_svg(const Chart& chart) {
  const ChartScales scales(chart);
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
