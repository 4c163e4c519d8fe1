#pragma once

namespace lather {

/// Lamé's parameters as the kernels read them. Made by neo_hookean_constants().
template <class Real>
struct NeoHookeanConstants {
  Real lame_lambda;  ///< lambda_e, Pa
  Real lame_mu;      ///< mu_e, Pa
};

}  // namespace lather
