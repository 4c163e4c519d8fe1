#pragma once

#include <string>

#include "sim/mpm/step.h"
#include "sim/report/report.h"

namespace lather::mpm {

/// The whole state as bytes: magic, `key`, state, and what the report has gathered. `key` names scene, level
/// and build.
template <class Real>
[[nodiscard]] std::string write_checkpoint(const State<Real>& state, const Report& report, int frame,
                                           const std::string& key);

/// The reverse; the sets of `state` must have been made for the same plan. Throws InputError for other or
/// damaged bytes.
template <class Real>
void read_checkpoint(const std::string& bytes, const std::string& key, State<Real>& state, Report& report,
                     int& frame);

}  // namespace lather::mpm
