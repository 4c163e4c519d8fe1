#pragma once

#include <optional>
#include <string>

#include "sim/study/flow_models.h"
#include "sim/study/rheometer.h"

namespace lather::study {

/// {"t": [s], "tau_xy": [Pa], "n1": [Pa], "s": [Pa]}, arrays of one length.
[[nodiscard]] std::string to_json(const StartUp& curve);

/// {"rate": [1/s], "tau_xy", "n1", "s": [Pa], "power_law": [Pa], "steady": [true …], "effective_viscosity":
/// {"matched_rate": 1/s, "herschel_bulkley", "viscoplastic", "bargteil": [Pa s]}}, arrays of one length;
/// power_law is tau_xy at small elastic strain. With a measured flow curve, also "measured": tau_xy by that,
/// and "measured_parameters": {"yield_stress": Pa, "viscosity": Pa s^h, "flow_index"} of a material that
/// flows so.
[[nodiscard]] std::string to_json(const HerschelBulkleyParameters& law, const std::vector<SteadyFlow>& curve,
                                  const std::optional<PowerLaw>& measured = {});

}  // namespace lather::study
