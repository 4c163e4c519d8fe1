#include "sim/scene/phase.h"

#include <algorithm>

namespace lather {
namespace {

struct ValueAt {
  double c;

  double operator()(const Smoothstep& s) const {
    const double u = std::clamp((c - s.from) / (s.to - s.from), 0.0, 1.0);
    return s.start + (s.end - s.start) * u * u * (3 - 2 * u);
  }
  double operator()(const CurveTable& t) const {
    const auto above = std::find_if(t.points.begin(), t.points.end(),
                                    [&](const CurvePoint& p) { return p.concentration > c; });
    if (above == t.points.begin()) return above->value;
    const CurvePoint& low = *(above - 1);
    if (above == t.points.end()) return low.value;
    const double u = (c - low.concentration) / (above->concentration - low.concentration);
    return low.value + (above->value - low.value) * u;
  }
  double operator()(const CurvePolynomial& p) const {
    double sum = 0;
    for (auto k = p.coefficients.rbegin(); k != p.coefficients.rend(); ++k) sum = sum * c + *k;
    return sum;
  }
};

}  // namespace

double value_at(const Curve& curve, double concentration) {
  return std::visit(ValueAt{std::clamp(concentration, 0.0, 1.0)}, curve);
}

const Curve* Phase::curve_of(const std::string& key) const {
  const auto found = std::find_if(by_concentration.begin(), by_concentration.end(),
                                  [&](const auto& entry) { return entry.first == key; });
  return found == by_concentration.end() ? nullptr : &found->second;
}

}  // namespace lather
