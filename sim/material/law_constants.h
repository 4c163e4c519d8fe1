#pragma once

#include "sim/material/drucker_prager_constants.h"
#include "sim/material/equation_of_state_constants.h"
#include "sim/material/herschel_bulkley_constants.h"
#include "sim/material/neo_hookean_constants.h"
#include "sim/material/newtonian_constants.h"
#include "sim/material/snow_constants.h"

namespace lather {

/// A law's constants; those of other laws than a material's own are not read. C is the run's precision, or
/// lanes of it where points of different concentrations have different ones.
template <class C>
struct LawConstants {
  HerschelBulkleyConstants<C> herschel_bulkley;
  NeoHookeanConstants<C> elastic;
  DruckerPragerConstants<C> drucker_prager;
  SnowConstants<C> snow;
  EquationOfStateConstants<C> liquid;
  NewtonianConstants<C> viscous;
  C swelling;  ///< J_r: volume at rest over the one at t = 0 [MLSRK eq. 30]; 1 where nothing swells
};

inline constexpr int kLaws = 5;  ///< alternatives of Law, in whose order tables of kernels stand

}  // namespace lather
