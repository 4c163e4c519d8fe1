#pragma once

namespace lather {

/// What a liquid's kernels read, in the precision of the run. Made by equation_of_state_constants().
template <class Real>
struct EquationOfStateConstants {
  Real bulk_modulus;  ///< K, Pa
  Real exponent;      ///< gamma, dimensionless, at least 1
};

}  // namespace lather
