#pragma once

namespace lather {

/// What the return mapping to Drucker and Prager's cone reads, in the precision of the run. Made by
/// drucker_prager_constants(), for one dimension.
template <class Real>
struct DruckerPragerConstants {
  Real slope;      ///< alpha (d lambda + 2 mu)/(2 mu), dimensionless: |dev eps| <= -slope tr eps
  Real cohesion;   ///< eps_c, dimensionless
  Real hardening;  ///< xi, dimensionless
};

}  // namespace lather
