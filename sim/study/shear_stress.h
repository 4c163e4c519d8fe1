#pragma once

#include <cmath>

namespace lather::study {

/// What a rheometer reads in simple shear along x, with y across the gap: Kirchhoff stresses, Pa.
struct ShearStress {
  double tau_xy = 0;
  double n1 = 0;  ///< first normal stress difference, tau_xx - tau_yy
  double s = 0;   ///< norm of the deviator, |dev tau|_F: sqrt(2) tau_xy at small strain
};

/// `tau`: xx yy zz xy xz yz, Pa.
[[nodiscard]] inline ShearStress shear_stress(const double* tau) {
  const double p = (tau[0] + tau[1] + tau[2]) / 3;
  double s2 = 0;
  for (int a = 0; a < 3; ++a) s2 += (tau[a] - p) * (tau[a] - p) + 2 * tau[3 + a] * tau[3 + a];
  return {tau[3], tau[0] - tau[1], std::sqrt(s2)};
}

}  // namespace lather::study
