#pragma once

namespace lather {

/// What the law's kernels read, in the precision of the run. Made by herschel_bulkley_constants().
template <class Real>
struct HerschelBulkleyConstants {
  Real bulk_modulus;        ///< kappa, Pa
  Real shear_modulus;       ///< mu, Pa
  Real yield_radius;        ///< sqrt(2/3) sigma_Y, Pa; infinite: elastic
  Real viscosity;           ///< eta, Pa s^h
  Real flow_index;          ///< h, dimensionless
  Real inverse_flow_index;  ///< 1/h
  Real epsilon;             ///< unit of rounding of Real
};

}  // namespace lather
