#pragma once

namespace lather {

/// Parameters of the elasto-viscoplastic Herschel-Bulkley law of "Continuum Foam" (Table I), SI units.
/// Perfect plastic: viscosity = 0. Bingham: flow_index = 1. Purely elastic: yield_stress = infinity.
struct HerschelBulkleyParameters {
  double density = 0;        ///< rho, kg/m^3
  double bulk_modulus = 0;   ///< kappa, Pa
  double shear_modulus = 0;  ///< mu, Pa
  double yield_stress = 0;   ///< sigma_Y, Pa; plastic flow starts at |s| = sqrt(2/3) sigma_Y
  double viscosity = 0;      ///< eta, Pa s^h (h: the flow index)
  double flow_index = 1;     ///< h, dimensionless; < 1 thins under shear, > 1 thickens
};

}  // namespace lather
