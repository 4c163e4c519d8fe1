#pragma once

#include <vector>

#include "sim/particles/particle_set.h"
#include "sim/report/report.h"
#include "sim/scene/scene.h"

namespace lather {

/// Mass, momenta, energies, extremes of the points; `sets[m]` are material m's. Density figures are left at
/// 0. Angular momentum counts APIC's affine part, m D (C_zy - C_yz, …) with D = h^2/3 (cubic), h^2/4
/// (quadratic).
template <class Real>
[[nodiscard]] FrameMeasure measure_points(const Scene& scene, const std::vector<ParticleSet<Real>>& sets,
                                          int threads);

}  // namespace lather
