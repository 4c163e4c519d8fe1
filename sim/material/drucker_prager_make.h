#pragma once

#include <cmath>

#include "sim/material/drucker_prager_constants.h"
#include "sim/material/drucker_prager_parameters.h"

namespace lather {

/// alpha of the yield condition |dev tau| <= -alpha tr tau. [MLSRK eq. 29] for triaxial compression, which
/// the paper takes in 2D as well. Plane strain: |dev tau| at Mohr and Coulomb's limit sin(phi) = (tau_1 -
/// tau_2) over -(tau_1 + tau_2), in 3D with the stress across the plane, to which flow drives it, in the
/// middle.
[[nodiscard]] inline double drucker_prager_alpha(double friction_angle_deg, FrictionMatch match,
                                                 int dimension) {
  constexpr double kRadians = 3.14159265358979323846 / 180;
  const double sine = std::sin(friction_angle_deg * kRadians);
  if (match == FrictionMatch::kTriaxialCompression) return std::sqrt(2.0 / 3) * 2 * sine / (3 - sine);
  return dimension == 2 ? sine / std::sqrt(2.0) : std::sqrt(2.0) / 3 * sine;
}

/// The parameters of yield and hardening as the kernels of 2 or 3 dimensions read them. Hardening scales both
/// of Lamé's parameters alike, so the slope does not depend on it.
template <class Real>
[[nodiscard]] DruckerPragerConstants<Real> drucker_prager_constants(const DruckerPragerParameters& p,
                                                                    int dimension) {
  const double nu = p.elastic.poisson_ratio;
  const double lambda_over_mu = 2 * nu / (1 - 2 * nu);
  const double alpha = drucker_prager_alpha(p.friction_angle_deg, p.match, dimension);
  return {static_cast<Real>(alpha * (dimension * lambda_over_mu / 2 + 1)), static_cast<Real>(p.cohesion),
          static_cast<Real>(p.hardening)};
}

}  // namespace lather
