#pragma once

#include <array>
#include <ostream>
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
inline void PrintTo(const SimpleShearRun& run, std::ostream* out) {
  *out << run.name();
}

using Mat9 = std::array<double, 9>;  ///< row by row

/// One weak point over one step: Algorithms 7, 8, 11 (limited) and 14 of "Continuum Foam". SI units.
struct TearingCase {
  Mat9 F, be;  ///< before the step; det be = 1
  double kappa, mu, dt, recovery_time;
  Mat9 velocity_gradient;
  double plasticity;
  Mat9 cauchy, cauchy_limited;                ///< Pa
  Mat9 f_limited, F_limited, be_pre_limited;  ///< after the limited step
  Mat9 F_recovered;                           ///< of F, by dt of recovery
};
std::vector<TearingCase> tearing_cases();

/// One plastic correction in 2 or 3 dimensions; in 2 the tensors are those of plane strain.
struct PlasticCase {
  int dimension;
  Mat9 trial;  ///< F_e before
  double plastic_volume;
  Mat9 expected;                   ///< F_e after
  double expected_plastic_volume;  ///< both J_p - 1
};

struct DruckerPragerCase : PlasticCase {
  double lame_lambda, lame_mu;  ///< Pa
  double friction_angle_deg, cohesion;
  std::string branch;  ///< tension, sliding or elastic
};
std::vector<DruckerPragerCase> drucker_prager_cases();

struct SnowCase : PlasticCase {
  double theta_c, theta_s, hardening;
  double stiffness_factor;  ///< exp(hardening (1 - J_p)) after
};
std::vector<SnowCase> snow_cases();

}  // namespace lather::testing_support
