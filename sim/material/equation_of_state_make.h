#pragma once

#include "sim/material/equation_of_state_constants.h"
#include "sim/material/liquid_parameters.h"

namespace lather {

/// A liquid's parameters as its kernels read them.
template <class Real>
[[nodiscard]] EquationOfStateConstants<Real> equation_of_state_constants(const LiquidParameters& p) {
  return {static_cast<Real>(p.bulk_modulus), static_cast<Real>(p.exponent)};
}

}  // namespace lather
