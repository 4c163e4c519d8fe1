#include "render/legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "render/canvas.h"
#include "render/colormap.h"

namespace lather::render {
namespace {

constexpr Rgba kInk = {38, 42, 48, 255};
constexpr Rgba kPanel = {255, 255, 255, 150};

double tick_step(double low, double high) {
  const double rough = (high - low) / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double step : {1.0, 2.0, 5.0})
    if (rough <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace

std::vector<double> tick_values(double low, double high) {
  if (!(high > low) || !std::isfinite(high - low)) return {low};
  const double step = tick_step(low, high);
  const double slack = 1e-6 * step;
  std::vector<double> ticks;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack && ticks.size() < 12; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::string tick_text(double value, double step) {
  if (std::abs(value) < 1e-6 * step) return "0";
  const int step_power = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const int value_power = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-9));
  std::array<char, 40> text{};
  if (value_power >= 5 || step_power < -4)
    std::snprintf(text.data(), text.size(), "%.*e", std::clamp(value_power - step_power, 0, 9), value);
  else
    std::snprintf(text.data(), text.size(), "%.*f", std::max(-step_power, 0), value);
  return text.data();
}

void draw_legend(Image& image, const ColorScale& scale) {
  Canvas canvas(image);
  const int u = std::max(1, static_cast<int>(std::lround(image.height / 360.0)));  // px of a font dot
  const std::vector<double> ticks = tick_values(scale.low, scale.high);
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : scale.high - scale.low;
  const std::string title =
      scale.unit.empty() || scale.unit == "1" ? scale.name : scale.name + " [" + scale.unit + "]";
  int label_width = 0;
  for (const double tick : ticks) label_width = std::max(label_width, text_width(tick_text(tick, step), u));

  const int bar_width = 9 * u, gap = 5 * u, pad = 7 * u;
  const int bar_height = static_cast<int>(image.height * 0.42);
  const int inner = std::max(bar_width + gap + label_width, text_width(title, u));
  const int height = bar_height + 3 * gap + kGlyphHeight * u;
  const int left = image.width - inner - 2 * pad - 6 * u, top = (image.height - height - 2 * pad) / 2;
  canvas.fill(left, top, inner + 2 * pad, height + 2 * pad, kPanel);
  canvas.text(left + pad, top + pad, title, u, kInk);

  const int bar_left = left + pad, bar_top = top + pad + 2 * gap + kGlyphHeight * u;
  const ColorMap map = ColorMap::named(scale.map);
  for (int y = 0; y < bar_height; ++y)
    canvas.fill(bar_left, bar_top + y, bar_width, 1, map.at(1 - (y + 0.5) / bar_height));
  for (const double tick : ticks) {
    const double t = (tick - scale.low) / (scale.high - scale.low);
    const int y = bar_top + static_cast<int>(std::lround((1 - t) * (bar_height - 1)));
    canvas.fill(bar_left + bar_width, y - u / 2, 3 * u, u, kInk);
    canvas.text(bar_left + bar_width + gap, y - kGlyphHeight * u / 2, tick_text(tick, step), u, kInk);
  }
}

}  // namespace lather::render
