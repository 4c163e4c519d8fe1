#pragma once

#include <functional>
#include <vector>

#include "sim/mpm/resample/conserved_values.h"

namespace lather::mpm::resample {

/// When a point of each set is weak.
struct TearTest {
  std::vector<double> tear_threshold;  ///< of each set; infinity: it does not tear
  /// |dev C^p|_F of a state (J - 1, then be - I as xx yy zz xy xz yz) and F - I (row by row).
  std::function<double(const double* state, const double* deformation)> plasticity;
};

/// The means of F and be need not fit each other: together they can show a plastic strain that no point
/// around has, and the new point would be torn from the start. Where one is weak and none of its donors is,
/// it takes F, J and be of the donor that gives most. `values` are those of compute_new_field_values().
template <class Real>
void mend_false_tears(const std::vector<NewPoint>& points, const PointBins& bins,
                      const std::vector<ParticleSet<Real>>& sets, const TearTest& test,
                      std::vector<double>& values);

}  // namespace lather::mpm::resample
