#pragma once

#include <vector>

#include "sim/mpm/step.h"
#include "sim/report/report.h"

namespace lather::mpm {

/// The probes' states at t = 0.
[[nodiscard]] std::vector<ProbeState> first_probe_states(const Scene& scene);

/// Their series: names and columns, no samples.
[[nodiscard]] std::vector<ProbeSeries> empty_probe_series(const Scene& scene);

/// Appends to `series` the samples that are due at the state's time. Changes the
/// probes' states and nothing else.
template <class Real>
void sample_probes(State<Real>& state, const Model<Real>& model, int threads,
                   std::vector<ProbeSeries>& series);

}  // namespace lather::mpm
