#pragma once

#include "sim/mpm/step.h"
#include "sim/report/report.h"

namespace lather::mpm {

/// Fills the density figures of `measure` from the state as it stands. Sorts the points if they have drifted.
template <class Real>
void measure_density(Stepper<Real>& stepper, State<Real>& state, const Model<Real>& model,
                     FrameMeasure& measure);

}  // namespace lather::mpm
