#pragma once

#include "sim/scene/scene.h"

namespace lather {

/// Speed of compression waves at rest, sqrt((kappa + 4/3 mu) / rho), m/s.
[[nodiscard]] double wave_speed(const HerschelBulkleyParameters& law);

/// Longest step that a wave allows, spacing over the fastest material's wave speed, s; without the safety
/// factor.
[[nodiscard]] double step_bound(const Scene& scene);

/// The step before points are fast: fixed, or safety factor times the bound (semi-implicit: times
/// implicit_step_factor), at most max_time_step and a frame, s.
[[nodiscard]] double planned_step(const Scene& scene);

/// alpha of a step of length dt: flip_blend^(dt / flip_blend_reference_step), so that the blend acts per
/// time.
[[nodiscard]] double flip_share(const Numerics& numerics, double dt);

/// Viscosity that the PIC part of the blend adds at step dt, Pa s: rho (1 - alpha) D h^2 / dt with D = 1/3
/// (cubic) or 1/4 (quadratic), the second moment of the kernel; 0 with APIC.
[[nodiscard]] double blend_viscosity(const Scene& scene, double density, double dt);

/// Diffusion of velocity that the blend is short of in a step of length dt, m^2/s: over a step longer than
/// the blend's own time, a filter that acts once a step cannot smooth as much as many short ones do. So the
/// semi-implicit solver adds it. 0 with APIC, and for pure PIC, which is defined per step.
[[nodiscard]] double missing_diffusion(const Scene& scene, double dt);

/// How many equal steps of at most `step` end exactly after `span` (s); at least 1.
[[nodiscard]] double steps_for(double span, double step);

}  // namespace lather
