#pragma once

namespace lather {

/// What the viscous stress's kernels read, in the precision of the run. Made by newtonian_constants().
template <class Real>
struct NewtonianConstants {
  Real viscosity;       ///< mu_v, Pa s
  Real bulk_viscosity;  ///< zeta_v, Pa s
};

}  // namespace lather
