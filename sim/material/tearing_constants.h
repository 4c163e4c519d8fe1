#pragma once

namespace lather {

/// What the kernels of tearing read, in the precision of the run.
template <class Real>
struct TearingConstants {
  Real tear_threshold;  ///< sigma_T, dimensionless; infinite: no tearing
};

}  // namespace lather
