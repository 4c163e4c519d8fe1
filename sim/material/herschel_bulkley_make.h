#pragma once

#include <cmath>
#include <limits>

#include "sim/material/herschel_bulkley_constants.h"
#include "sim/material/herschel_bulkley_parameters.h"

namespace lather {

/// The law's parameters as its kernels read them.
template <class Real>
[[nodiscard]] HerschelBulkleyConstants<Real> herschel_bulkley_constants(const HerschelBulkleyParameters& p) {
  return {static_cast<Real>(p.bulk_modulus),
          static_cast<Real>(p.shear_modulus),
          static_cast<Real>(std::sqrt(2.0 / 3.0) * p.yield_stress),
          static_cast<Real>(p.viscosity),
          static_cast<Real>(p.flow_index),
          static_cast<Real>(1 / p.flow_index),
          std::numeric_limits<Real>::epsilon()};
}

}  // namespace lather
