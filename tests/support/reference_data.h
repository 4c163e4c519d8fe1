#pragma once

#include <string>
#include <vector>

#include "sim/material/herschel_bulkley_parameters.h"

/// Reference solutions in tests/data, integrated or solved to 25 digits by an independent program.
namespace lather::testing_support {

/// One return mapping: s - s_pre = -2 mu~ dt ((s - sqrt(2/3) sigma_Y)/eta)^(1/h). SI units.
struct ReturnMapCase {
  double s_pre, mu_tilde_dt, sigma_y, eta, h;
  double excess;  ///< s - sqrt(2/3) sigma_Y, Pa
};
std::vector<ReturnMapCase> return_map_cases();

/// Start-up of simple shear v = (rate y, 0, 0) from rest strain; Kirchhoff stresses in Pa.
struct SimpleShearRun {
  double mu, sigma_y, eta, h, shear_rate;
  std::vector<double> t, tau_xy, n1, s;

  [[nodiscard]] HerschelBulkleyParameters law() const;
  [[nodiscard]] double largest_s() const;
  [[nodiscard]] std::string name() const;
};
std::vector<SimpleShearRun> simple_shear_runs();

}  // namespace lather::testing_support
