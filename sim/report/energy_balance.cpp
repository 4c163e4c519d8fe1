#include "sim/report/energy_balance.h"

#include <algorithm>
#include <limits>

#include "sim/plan/step_bound.h"

namespace lather {

double total_energy(const Scene& scene, const FrameMeasure& frame) {
  const Box3& box = scene.domain.box;
  double least = 0;  // gravity's potential, m^2/s^2
  for (int axis = 0; axis < scene.dimension; ++axis)
    least += std::min(-scene.gravity[axis] * box.min[axis], -scene.gravity[axis] * box.max[axis]);
  // What the forces of the MLSRK solver balance is the energy of the masses that they are divided by.
  const bool lumped = frame.lumped && scene.numerics.mlsrk.inertial_mass == InertialMass::kLumped;
  const double kinetic = lumped ? frame.lumped->kinetic_energy : frame.kinetic_energy;
  return kinetic + frame.elastic_volume_energy + frame.elastic_shear_energy + frame.gravity_energy -
         frame.mass * least;
}

double rounding_energy(const Scene& scene, const FrameMeasure& frame) {
  double fastest = 0;
  for (const Material& m : scene.materials) fastest = std::max(fastest, wave_speed(m.law));
  const double unit = scene.numerics.precision == Precision::kFloat ? std::numeric_limits<float>::epsilon()
                                                                    : std::numeric_limits<double>::epsilon();
  const double wrong = 100 * unit * fastest;
  return 0.5 * frame.mass * wrong * wrong;
}

bool is_driven(const Scene& scene) {
  const auto moves = [](const auto& thing) { return !std::holds_alternative<AtRest>(thing.motion); };
  for (int axis = 0; axis < scene.dimension; ++axis)
    if (scene.domain.periodic[static_cast<std::size_t>(axis)] && scene.gravity[axis] != 0) return true;
  const auto corrected = [&](const Material& m) {
    return scene.solver == Solver::kMlsrk && scene.numerics.mlsrk.volume_correction &&
           m.takes_volume_correction();
  };
  return !scene.emitters.empty() || std::any_of(scene.materials.begin(), scene.materials.end(), corrected) ||
         scene.has_phases() || std::any_of(scene.obstacles.begin(), scene.obstacles.end(), moves) ||
         std::any_of(scene.grips.begin(), scene.grips.end(), moves);
}

}  // namespace lather
