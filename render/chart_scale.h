#pragma once

#include <vector>

namespace lather::render {

/// From values of an axis to the fraction of its length, and where its ticks stand.
class ChartScale {
 public:
  /// Covers the values that can be shown, widened to whole ticks.
  ChartScale(const std::vector<const std::vector<double>*>& values, bool logarithmic);

  [[nodiscard]] bool shows(double value) const;
  [[nodiscard]] double fraction(double value) const;  ///< 0 at the lower end, 1 at the upper
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

 private:
  void cover_linear(double low, double high);
  void cover_decades(double low, double high);

  bool logarithmic_;
  double low_ = 0;  // of the value, or of its logarithm to base 10
  double high_ = 1;
  std::vector<double> ticks_;
};

}  // namespace lather::render
