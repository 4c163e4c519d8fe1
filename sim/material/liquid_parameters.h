#pragma once

#include "sim/material/elastic_parameters.h"

namespace lather {

/// A weakly compressible liquid: p = (K/gamma) (J^-gamma - 1), never below 0, and Newtonian viscosity.
/// [MLSRK Fig. 3; Becker and Teschner 2007]
struct LiquidParameters {
  double density = 0;       ///< rho, kg/m^3
  double bulk_modulus = 0;  ///< K, Pa
  double exponent = 7;      ///< gamma, dimensionless
  ViscousParameters viscous;
};

}  // namespace lather
