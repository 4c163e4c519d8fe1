#pragma once

#include <cmath>

#include "sim/material/snow_constants.h"
#include "sim/material/snow_parameters.h"

namespace lather {

/// The parameters of yield and hardening as the kernels read them.
template <class Real>
[[nodiscard]] SnowConstants<Real> snow_constants(const SnowParameters& p) {
  return {static_cast<Real>(std::log1p(-p.critical_compression)),
          static_cast<Real>(std::log1p(p.critical_stretch)), static_cast<Real>(p.hardening)};
}

}  // namespace lather
