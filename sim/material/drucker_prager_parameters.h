#pragma once

#include "sim/material/elastic_parameters.h"

namespace lather {

/// Which stress states the friction angle is matched at: triaxial compression, as the paper has it (in plane
/// strain 30 degrees then act as 43.9 in 3D, as 27.5 in 2D), or plane strain.
enum class FrictionMatch { kTriaxialCompression, kPlaneStrain };

/// A neo-Hookean solid that yields by Drucker and Prager's cone: grains, powders, brittle things; without
/// friction and cohesion a fluid. [MLSRK eq. 25-29]
struct DruckerPragerParameters {
  ElasticParameters elastic;
  ViscousParameters viscous;
  double friction_angle_deg = 0;  ///< phi_f, degrees
  FrictionMatch match = FrictionMatch::kTriaxialCompression;
  double cohesion = 0;   ///< eps_c: logarithmic strain that it bears in tension, dimensionless
  double hardening = 0;  ///< xi: moduli grow by exp(xi (1 - J_p)), dimensionless
};

}  // namespace lather
