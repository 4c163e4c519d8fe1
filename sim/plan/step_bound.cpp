#include "sim/plan/step_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lather {

double wave_speed(const HerschelBulkleyParameters& law) {
  return std::sqrt((law.bulk_modulus + 4.0 / 3.0 * law.shear_modulus) / law.density);
}

double wave_speed(const Law& law) {
  struct Speed {
    double operator()(const HerschelBulkleyParameters& p) const { return wave_speed(p); }
    double operator()(const NeoHookeanParameters& p) const { return of(p.elastic); }
    double operator()(const DruckerPragerParameters& p) const { return of(p.elastic); }
    double operator()(const SnowParameters& p) const { return of(p.elastic); }
    double operator()(const LiquidParameters& p) const { return std::sqrt(p.bulk_modulus / p.density); }
    static double of(const ElasticParameters& p) {
      return std::sqrt((p.lame_lambda() + 2 * p.lame_mu()) / p.density);
    }
  };
  return std::visit(Speed{}, law);
}

double viscous_diffusion(const Law& law, int dimension) {
  struct Viscous {
    ViscousParameters operator()(const HerschelBulkleyParameters&) const { return {}; }
    ViscousParameters operator()(const NeoHookeanParameters& p) const { return p.viscous; }
    ViscousParameters operator()(const DruckerPragerParameters& p) const { return p.viscous; }
    ViscousParameters operator()(const SnowParameters&) const { return {}; }
    ViscousParameters operator()(const LiquidParameters& p) const { return p.viscous; }
  };
  const ViscousParameters v = std::visit(Viscous{}, law);
  const double along = 2 * (1 - 1.0 / dimension) * v.viscosity + v.bulk_viscosity;
  return (along + v.viscosity) / density(law);
}

double phase_step_bound(const Scene& scene) {
  double mobility = 0;
  for (const Material& m : scene.materials)
    if (m.phase) mobility = std::max(mobility, m.phase->mobility);
  const double a = 0.5 * scene.numerics.mlsrk.support_radius * scene.spacing;
  const double width = scene.numerics.mlsrk.phases.interface_width.value_or(a);
  const double squared_wave_number = scene.dimension / (scene.spacing * scene.spacing);
  const double rate = mobility * squared_wave_number * (2 + width * width * 7 / (a * a));
  return rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
}

double step_bound(const Scene& scene) {
  double bound = phase_step_bound(scene);
  const auto count = [&](const std::string& name) {
    for (const Material& m : scene.materials) {
      if (m.name != name) continue;
      for (const Law& law : m.laws()) {
        bound = std::min(bound, scene.spacing / wave_speed(law));
        const double diffusion = viscous_diffusion(law, scene.dimension);
        if (diffusion > 0) bound = std::min(bound, scene.spacing * scene.spacing / (2 * diffusion));
      }
    }
  };
  for (const Body& body : scene.bodies)
    for (const std::string& name : body.material_names()) count(name);
  for (const Emitter& emitter : scene.emitters) count(emitter.material);
  return bound;
}

double planned_step(const Scene& scene, double bound) {
  const Numerics& n = scene.numerics;
  const double factor = n.integration == Integration::kSemiImplicit ? n.implicit_step_factor : 1;
  const double step =
      n.time_step > 0 ? n.time_step : std::min(factor * n.safety_factor * bound, n.max_time_step);
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

double velocity_blend_viscosity(const Scene& scene, double density, double dt) {
  const Mlsrk& n = scene.numerics.mlsrk;
  const double a = 0.5 * n.support_radius * scene.spacing;
  const double kept = std::pow(n.velocity_blend, dt / n.velocity_blend_reference_step);
  return density * (1 - kept) * a * a / (6 * dt);
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
