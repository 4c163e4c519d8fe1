#pragma once

#include "sim/material/elastic_parameters.h"
#include "sim/material/neo_hookean_constants.h"

namespace lather {

/// The elastic part of a solid as the kernels read it. [MLSRK eq. 21]
template <class Real>
[[nodiscard]] NeoHookeanConstants<Real> neo_hookean_constants(const ElasticParameters& p) {
  return {static_cast<Real>(p.lame_lambda()), static_cast<Real>(p.lame_mu())};
}

}  // namespace lather
