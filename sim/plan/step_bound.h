#pragma once

#include "sim/scene/scene.h"

namespace lather {

/// Speed of compression waves at rest, m/s: sqrt((lambda + 2 mu) / rho), which is sqrt(K / rho) of liquids.
/// Hardening (snow, drucker-prager) is left out: it starts at 1, and the running step counts what it has come
/// to.
[[nodiscard]] double wave_speed(const HerschelBulkleyParameters& law);
[[nodiscard]] double wave_speed(const Law& law);

/// Diffusion of velocity by a law's Newtonian viscosity, m^2/s: of its change along the direction it varies
/// in, (2 (1 - 1/d) mu_v + zeta_v) / rho, and across it, mu_v / rho, together, as surfaces mix both.
/// [MLSRK eq. 23]
[[nodiscard]] double viscous_diffusion(const Law& law, int dimension);

/// Longest step that the diffusion of concentrations allows, s, without the safety factor. A mode of wave
/// number k fades at the rate L (H'' k^2 + eps^2 k^2 |lap|), H'' <= 2 [MLSRK eq. 13-16]. k^2 <= d /
/// spacing^2, see step_bound(); the Laplacian's symbol is 2 d (1 - w(k)) over the second moment of the
/// kernel, d a^2 / 3 or a little less, w >= 0 its transform, so below 7 / a^2. Half of what explicit steps
/// then bear.
[[nodiscard]] double phase_step_bound(const Scene& scene);

/// Longest step that waves, viscosity and, in the MLSRK solver, diffusion allow, s; without the safety
/// factor. The smallest, over materials and concentrations, of spacing / wave speed and spacing^2 / (2
/// viscous_diffusion()), and phase_step_bound().
///
/// Both are below what explicit steps bear where points are many. In a lattice a gradient that is exact for
/// linear functions sees a wave number of 1/spacing at the most along each axis, so k^2 <= d / spacing^2;
/// waves are stable to 2 / (c k) >= 1.15 spacing / c, diffusion to 2 / (nu k^2) >= 0.67 spacing^2 / nu. Light
/// points at surfaces are left to the safety factor. On a grid k^2 <= 1.5 / spacing^2 in any direction,
/// quadratic splines' largest stiffness over lumped mass, (2 - 2 cos k) (2 + cos k) / 3; of cubic ones it
/// is 1.08.
[[nodiscard]] double step_bound(const Scene& scene);

/// Longest explicit step on a grid that is stable for any arrangement of points, s; infinite for a scene of
/// the MLSRK solver. No mode of all points is faster than the fastest one of a point that had the nodes
/// around it for itself (stiffness and lumped mass are sums over points): of that, with sum_i N_i,a N_i,b /
/// N_i = s / h^2 delta_ab, omega^2 = s C / (rho h^2) and the rate of decay is s V / (rho h^2), where C is the
/// largest of d lambda + 2 mu (change of volume) and 2 mu (of form), V that of d zeta_v and 2 mu_v. s is at
/// most 6 for quadratic splines and 3.137 for cubic ones, wherever the point is. A step from velocities of
/// its start, which viscosity is taken at, is stable while omega^2 dt^2 / 4 + rate dt / 2 <= 1.
[[nodiscard]] double lone_point_bound(const Scene& scene);

/// The step before points are fast: fixed, or safety factor times `bound`, the scene's step_bound()
/// (semi-implicit: times implicit_step_factor), at most max_time_step and a frame, s. An automatic explicit
/// step is never beyond 0.9 of lone_point_bound().
[[nodiscard]] double planned_step(const Scene& scene, double bound);

/// alpha of a step of length dt: flip_blend^(dt / flip_blend_reference_step), so that the blend acts per
/// time.
[[nodiscard]] double flip_share(const Numerics& numerics, double dt);

/// Viscosity that the PIC part of the blend adds at step dt, Pa s: rho (1 - alpha) D h^2 / dt with D = 1/3
/// (cubic) or 1/4 (quadratic), the second moment of the kernel; 0 with APIC.
[[nodiscard]] double blend_viscosity(const Scene& scene, double density, double dt);

/// Viscosity that the MLSRK solver's blend of velocities adds at step dt, Pa s: rho (1 - alpha) a^2 / (6 dt),
/// where a is half the support radius and alpha = velocity_blend^(dt / velocity_blend_reference_step).
/// [MLSRK eq. 12]
[[nodiscard]] double velocity_blend_viscosity(const Scene& scene, double density, double dt);

/// Viscosity that the time step itself adds against change of form, Pa s, at rest. Semi-implicit steps damp
/// as a diffusion of (2 beta - 1) c^2 dt does, c^2 = mu/rho: (2 beta - 1) mu dt. Explicit ones on a grid
/// strain points by the grid's new velocity, which has been smoothed less often than their own
/// (sim/study/verify/standing_wave.cpp): a wave k loses as under mu dt (k h)^2 / 3, given for one of eight
/// cells. Explicit steps of points alone add none.
[[nodiscard]] double step_viscosity(const Scene& scene, const Law& law, double dt);

/// Diffusion of velocity that the blend is short of in a step of length dt, m^2/s: over a step longer than
/// the blend's own time, a filter that acts once a step cannot smooth as much as many short ones do. So the
/// semi-implicit solver adds it. 0 with APIC, and for pure PIC, which is defined per step.
[[nodiscard]] double missing_diffusion(const Scene& scene, double dt);

/// How many equal steps of at most `step` end exactly after `span` (s); at least 1.
[[nodiscard]] double steps_for(double span, double step);

}  // namespace lather
