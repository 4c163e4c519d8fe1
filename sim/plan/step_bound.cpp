#include "sim/plan/step_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lather {

namespace {

/// What stretched material needs: a volume's stiffness kappa J^2 [Foam eq. 2] makes steps shorter by 1/J, and
/// points of a block that hits the floor at a tenth of the wave speed reach J = 1.08.
constexpr double kShareOfLoneBound = 0.9;

/// Of a law that has one; else none.
ViscousParameters newtonian_viscosity(const Law& law) {
  struct Viscous {
    ViscousParameters operator()(const HerschelBulkleyParameters&) const { return {}; }
    ViscousParameters operator()(const NeoHookeanParameters& p) const { return p.viscous; }
    ViscousParameters operator()(const DruckerPragerParameters& p) const { return p.viscous; }
    ViscousParameters operator()(const SnowParameters&) const { return {}; }
    ViscousParameters operator()(const LiquidParameters& p) const { return p.viscous; }
  };
  return std::visit(Viscous{}, law);
}

/// Pa, at rest.
struct LameModuli {
  double lambda = 0;
  double mu = 0;
};
LameModuli lame_moduli(const Law& law) {
  struct Moduli {
    LameModuli operator()(const HerschelBulkleyParameters& p) const {
      return {p.bulk_modulus - 2.0 / 3.0 * p.shear_modulus, p.shear_modulus};
    }
    LameModuli operator()(const NeoHookeanParameters& p) const { return of(p.elastic); }
    LameModuli operator()(const DruckerPragerParameters& p) const { return of(p.elastic); }
    LameModuli operator()(const SnowParameters& p) const { return of(p.elastic); }
    LameModuli operator()(const LiquidParameters& p) const { return {p.bulk_modulus, 0}; }
    static LameModuli of(const ElasticParameters& p) { return {p.lame_lambda(), p.lame_mu()}; }
  };
  return std::visit(Moduli{}, law);
}

/// Calls visit(law) for every law that a point of the scene may have.
template <class Visit>
void for_laws(const Scene& scene, const Visit& visit) {
  const auto visit_material = [&](const std::string& name) {
    for (const Material& m : scene.materials)
      if (m.name == name)
        for (const Law& law : m.laws()) visit(law);
  };
  for (const Body& body : scene.bodies)
    for (const std::string& name : body.material_names()) visit_material(name);
  for (const Emitter& emitter : scene.emitters) visit_material(emitter.material);
}

}  // namespace

double wave_speed(const HerschelBulkleyParameters& law) {
  return std::sqrt((law.bulk_modulus + 4.0 / 3.0 * law.shear_modulus) / law.density);
}

double wave_speed(const Law& law) {
  if (const auto* foam = std::get_if<HerschelBulkleyParameters>(&law)) return wave_speed(*foam);
  const LameModuli moduli = lame_moduli(law);
  return std::sqrt((moduli.lambda + 2 * moduli.mu) / density(law));
}

double viscous_diffusion(const Law& law, int dimension) {
  const ViscousParameters v = newtonian_viscosity(law);
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
  for_laws(scene, [&](const Law& law) {
    bound = std::min(bound, scene.spacing / wave_speed(law));
    const double diffusion = viscous_diffusion(law, scene.dimension);
    if (diffusion > 0) bound = std::min(bound, scene.spacing * scene.spacing / (2 * diffusion));
  });
  return bound;
}

double lone_point_bound(const Scene& scene) {
  double bound = std::numeric_limits<double>::infinity();
  if (scene.solver != Solver::kMpm) return bound;
  const double s = scene.numerics.kernel == Kernel::kCubic ? 3.137 : 6;
  for_laws(scene, [&](const Law& law) {
    const double unit = s / (density(law) * scene.spacing * scene.spacing);
    const LameModuli m = lame_moduli(law);
    const ViscousParameters v = newtonian_viscosity(law);
    const double squared = unit * std::max(scene.dimension * m.lambda + 2 * m.mu, 2 * m.mu);
    const double half_rate = 0.5 * unit * std::max(scene.dimension * v.bulk_viscosity, 2 * v.viscosity);
    bound = std::min(bound, 2 / (half_rate + std::sqrt(half_rate * half_rate + squared)));
  });
  return bound;
}

double planned_step(const Scene& scene, double bound) {
  const Numerics& n = scene.numerics;
  double share = n.safety_factor;
  if (n.integration == Integration::kSemiImplicit)
    share *= n.implicit_step_factor;
  else if (scene.solver == Solver::kMpm)
    share = std::min(share, kShareOfLoneBound * lone_point_bound(scene) / step_bound(scene));
  const double step = n.time_step > 0 ? n.time_step : std::min(share * bound, n.max_time_step);
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

double step_viscosity(const Scene& scene, const Law& law, double dt) {
  const double shear = lame_moduli(law).mu;
  if (scene.numerics.integration == Integration::kSemiImplicit)
    return (2 * scene.numerics.implicit_share - 1) * shear * dt;
  if (scene.solver != Solver::kMpm) return 0;
  const double phase = 2 * std::numbers::pi / 8;  // k h
  return shear * dt * phase * phase / 3;
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
