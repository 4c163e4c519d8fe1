#pragma once

#include "sim/material/elastic_parameters.h"

namespace lather {

/// A neo-Hookean solid, perhaps viscous. [MLSRK eq. 20-23]
struct NeoHookeanParameters {
  ElasticParameters elastic;
  ViscousParameters viscous;
};

}  // namespace lather
