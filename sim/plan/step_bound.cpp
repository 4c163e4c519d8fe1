#include "sim/plan/step_bound.h"

#include <algorithm>
#include <cmath>

namespace lather {

double wave_speed(const HerschelBulkleyParameters& law) {
  return std::sqrt((law.bulk_modulus + 4.0 / 3.0 * law.shear_modulus) / law.density);
}

double step_bound(const Scene& scene) {
  double fastest = 0;
  const auto count = [&](const std::string& material) {
    for (const Material& m : scene.materials)
      if (m.name == material) fastest = std::max(fastest, wave_speed(m.herschel_bulkley));
  };
  for (const Body& body : scene.bodies) count(body.material);
  for (const Emitter& emitter : scene.emitters) count(emitter.material);
  return scene.spacing / fastest;
}

double planned_step(const Scene& scene) {
  const Numerics& n = scene.numerics;
  const double factor = n.integration == Integration::kSemiImplicit ? n.implicit_step_factor : 1;
  const double step =
      n.time_step > 0 ? n.time_step : std::min(factor * n.safety_factor * step_bound(scene), n.max_time_step);
  return std::min(step, 1 / scene.frame_rate);
}

double flip_share(const Numerics& numerics, double dt) {
  return std::pow(numerics.flip_blend, dt / numerics.flip_blend_reference_step);
}

double blend_viscosity(const Scene& scene, double density, double dt) {
  if (scene.numerics.transfer == Transfer::kApic) return 0;
  const double moment = scene.numerics.kernel == Kernel::kCubic ? 1.0 / 3.0 : 0.25;
  return density * (1 - flip_share(scene.numerics, dt)) * moment * scene.spacing * scene.spacing / dt;
}

double missing_diffusion(const Scene& scene, double dt) {
  const Numerics& n = scene.numerics;
  if (n.transfer == Transfer::kApic || n.flip_blend == 0) return 0;
  // blend_viscosity() as dt tends to 0, where 1 - alpha tends to rate dt.
  const double rate = -std::log(n.flip_blend) / n.flip_blend_reference_step;
  const double moment = n.kernel == Kernel::kCubic ? 1.0 / 3.0 : 0.25;
  return std::max(0.0, rate * moment * scene.spacing * scene.spacing - blend_viscosity(scene, 1, dt));
}

double steps_for(double span, double step) {
  return std::max(1.0, std::ceil(span / step * (1 - 1e-9)));
}

}  // namespace lather
