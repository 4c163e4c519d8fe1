#include "render/chart_scale.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lather::render {
namespace {

/// The width among 1, 2 and 5 times a power of ten that divides `span` into about five.
double tick_width(double span) {
  const double raw = span / 5;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  const double leading = raw / power;
  if (leading < 1.5) return power;
  if (leading < 3.5) return 2 * power;
  return leading < 7.5 ? 5 * power : 10 * power;
}

}  // namespace

ChartScale::ChartScale(const std::vector<const std::vector<double>*>& values, bool logarithmic)
    : logarithmic_(logarithmic) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::vector<double>* list : values)
    for (const double v : *list) {
      if (!shows(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  const bool none = low > high;
  if (logarithmic_)
    cover_decades(none ? 1 : low, none ? 10 : high);
  else
    cover_linear(none ? 0 : low, none ? 1 : high);
}

bool ChartScale::shows(double value) const {
  return std::isfinite(value) && (!logarithmic_ || value > 0);
}

double ChartScale::fraction(double value) const {
  return ((logarithmic_ ? std::log10(value) : value) - low_) / (high_ - low_);
}

void ChartScale::cover_linear(double low, double high) {
  if (low > 0 && low < 0.5 * high) low = 0;  // a curve that comes near zero is seen against zero
  if (high == low) {
    const double margin = low == 0 ? 1 : 0.5 * std::abs(low);
    low -= margin;
    high += margin;
  }
  const double width = tick_width(high - low);
  const double first = std::floor(low / width + 1e-9);
  const double last = std::ceil(high / width - 1e-9);
  low_ = first * width;
  high_ = last * width;
  for (double i = first; i <= last; ++i) ticks_.push_back(i * width);
}

void ChartScale::cover_decades(double low, double high) {
  low_ = std::floor(std::log10(low) + 1e-9);
  high_ = std::max(low_ + 1, std::ceil(std::log10(high) - 1e-9));
  const double width = std::ceil((high_ - low_) / 10);  // at most eleven labels
  for (double i = low_; i <= high_; i += width) ticks_.push_back(std::pow(10, i));
}

}  // namespace lather::render
