#include "render/chart_layout.h"

#include <array>

namespace lather::render {
namespace {

std::vector<const std::vector<double>*> columns(const Chart& chart, std::vector<double> ChartSeries::*of) {
  std::vector<const std::vector<double>*> all;
  for (const ChartSeries& s : chart.series) all.push_back(&(s.*of));
  return all;
}

}  // namespace

double legend_top(std::size_t series) {
  return kTop + 10 + 22 * static_cast<double>(series);
}

Rgba chart_color(std::size_t series) {
  static constexpr std::array<Rgba, 7> kColors = {{{0x00, 0x72, 0xb2, 255},
                                                   {0xd5, 0x5e, 0x00, 255},
                                                   {0x00, 0x9e, 0x73, 255},
                                                   {0xcc, 0x79, 0xa7, 255},
                                                   {0xe6, 0x9f, 0x00, 255},
                                                   {0x56, 0xb4, 0xe9, 255},
                                                   {0x00, 0x00, 0x00, 255}}};
  return kColors[series % kColors.size()];
}

ChartScales::ChartScales(const Chart& chart)
    : x_(columns(chart, &ChartSeries::x), chart.x.logarithmic),
      y_(columns(chart, &ChartSeries::y), chart.y.logarithmic) {}

double ChartScales::left(double value) const {
  return kLeft + x_.fraction(value) * (kWidth - kLeft - kRight);
}

double ChartScales::top(double value) const {
  return kHeight - kBottom - y_.fraction(value) * (kHeight - kTop - kBottom);
}

}  // namespace lather::render
