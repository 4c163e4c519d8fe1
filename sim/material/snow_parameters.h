#pragma once

#include "sim/material/elastic_parameters.h"

namespace lather {

/// A neo-Hookean solid whose stretches are clamped, and which hardens as it is compressed (Stomakhin et al.
/// 2013). [MLSRK section 4.3.4, eq. 25]
struct SnowParameters {
  ElasticParameters elastic;
  double critical_compression = 2.5e-2;  ///< theta_c, dimensionless
  double critical_stretch = 7.5e-3;      ///< theta_s, dimensionless
  double hardening = 10;                 ///< xi: moduli grow by exp(xi (1 - J_p)), dimensionless
};

}  // namespace lather
