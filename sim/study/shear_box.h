#pragma once

#include "sim/scene/scene.h"
#include "sim/simulation.h"
#include "sim/study/rheometer.h"

namespace lather::study {

/// Start-up of simple shear by the whole method: an MPM box, periodic along the flow and across it, between
/// moving walls, started from v = rate y, the stress read in the middle half of the gap.
///
/// Density, bulk modulus and cell width do not enter the exact solution (v = rate y is steady, J = 1). They
/// are chosen so that a stable step shears by about 5e-4: a scene of the law's own time scale.
[[nodiscard]] Scene shear_box_scene(const HerschelBulkleyParameters& law, const StartUpRequest& request);

/// The same by the MLSRK solver, in plane strain (where simple shear is what it is in space), without periods
/// across: the outer five layers of points on each side are the walls and hold the flow's velocity.
[[nodiscard]] Scene particle_shear_box_scene(const HerschelBulkleyParameters& law,
                                             const StartUpRequest& request);

/// The stress is read where |y| is less than this, m: the middle half of the gap.
[[nodiscard]] double middle_half(const Scene& shear_box);

/// Mean stresses over the points that are nearer than `half` (m) to the middle plane.
[[nodiscard]] ShearStress middle_stress(const Simulation& simulation, double half);

/// Longest start-up in the box as shear, dimensionless: a shear of 1 takes about 1500 steps of 2304 points.
inline constexpr double kMostBoxShear = 100;

/// `threads` = 0 takes all cores. Throws InputError for values out of range.
[[nodiscard]] StartUp start_up_in_box(const HerschelBulkleyParameters& law, const StartUpRequest& request,
                                      int threads, Solver solver = Solver::kMpm);

}  // namespace lather::study
