#pragma once

#include "sim/mpm/step.h"

namespace lather::mpm {

/// Adds the points of every release that is due at the state's time and whose place is free. Depends on the
/// state alone, so that a restored run releases the same.
template <class Real>
void emit_due(State<Real>& state, const Scene& scene);

}  // namespace lather::mpm
