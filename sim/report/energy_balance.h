#pragma once

#include "sim/report/report.h"
#include "sim/scene/scene.h"

/// Energy that material has, and whether anything may give it more.
namespace lather {

/// Kinetic, elastic and potential energy of a frame, J; the latter is zero where gravity's potential is least
/// in the domain, so it is positive.
[[nodiscard]] double total_energy(const Scene& scene, const FrameMeasure& frame);

/// Energy that rounding alone gives to the mass of a frame, J: velocities that are wrong by a hundred units
/// in the last place of the wave speed, as forces of strains that are wrong by so much make them.
[[nodiscard]] double rounding_energy(const Scene& scene, const FrameMeasure& frame);

/// Can anything but its own motion give the material energy: things that move, material that comes in, swells
/// or has its volume set anew by the volume correction, or gravity along an axis without an end?
[[nodiscard]] bool is_driven(const Scene& scene);

}  // namespace lather
