#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/material/herschel_bulkley_parameters.h"
#include "sim/study/shear_stress.h"

/// The virtual rheometer: simple shear v = (rate y, 0, 0) of a material, from the law alone. Stresses are
/// Kirchhoff's, in Pa; the volume does not change (J = 1), so they are Cauchy's, too. Density and bulk
/// modulus do not enter.
namespace lather::study {

/// Start-up of shear from a state without strain.
struct StartUp {
  double rate = 0;        ///< 1/s
  std::vector<double> t;  ///< s, from 0
  std::vector<ShearStress> stress;
};

/// What start_up() is asked for.
struct StartUpRequest {
  double rate = 1;            ///< of shear, 1/s
  double time = 3;            ///< s
  std::int64_t steps = 2000;  ///< intervals between readings; readings = steps + 1
};

inline constexpr double kMostShear = 1000;  ///< of a start-up, rate * time, dimensionless
inline constexpr int kMostReadings = 100'000;

/// Throws InputError, with all that is wrong, for values out of range.
void check(const StartUpRequest& request, double most_shear = kMostShear);

/// Integrates the law's own time step; a reading's interval is divided so that no step shears by more than
/// 1e-4, which keeps the stress within 3e-4 of its largest value (the error is of first order in the step).
/// Throws InputError for values out of range.
[[nodiscard]] StartUp start_up(const HerschelBulkleyParameters& law, const StartUpRequest& request);

/// A steady state at one rate of shear.
struct SteadyFlow {
  double rate = 0;  ///< 1/s
  ShearStress stress;
  bool steady = false;  ///< false: the stress still changed after a shear of 200
};

/// Which rates of shear a flow curve has: `count` of them, evenly spaced in their logarithm.
struct RateRange {
  double lowest = 0.01;  ///< 1/s
  double highest = 100;  ///< 1/s
  int count = 21;
};

/// Reads "0.01:100" or "0.01:100:41" (lowest:highest:count; five a decade without a count). Throws
/// InputError.
[[nodiscard]] RateRange read_rate_range(const std::string& text);

/// The steady states: shears from rest until the stress changes by less than a millionth of itself over a
/// shear of 0.1. Throws InputError for a material that cannot flow (infinite yield stress).
[[nodiscard]] std::vector<SteadyFlow> flow_curve(const HerschelBulkleyParameters& law,
                                                 const RateRange& range);

}  // namespace lather::study
