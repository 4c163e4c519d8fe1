#pragma once

#include "sim/material/elastic_parameters.h"
#include "sim/material/newtonian_constants.h"

namespace lather {

/// The parameters as the kernels read them.
template <class Real>
[[nodiscard]] NewtonianConstants<Real> newtonian_constants(const ViscousParameters& p) {
  return {static_cast<Real>(p.viscosity), static_cast<Real>(p.bulk_viscosity)};
}

}  // namespace lather
