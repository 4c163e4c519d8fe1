// Without a yield stress and with h = 1 the law is Maxwell's at small elastic strain: shear viscosity K =
// eta/2, relaxation time lambda = K/mu, and in start-up of shear
//
//   tau_xy(t) = K rate (1 - exp(-t/lambda)).
//
// Finite elastic strain e = s/mu adds terms of order e^2; e is at most 0.03.

#include "sim/study/verify/couette.h"

#include <algorithm>
#include <cmath>

#include "sim/study/flow_models.h"
#include "sim/study/shear_box.h"

namespace lather::study {
namespace {

constexpr HerschelBulkleyParameters kFluid = {1000, 1e5, 1e3, 0, 40, 1};

double viscosity() {
  return power_law(kFluid).consistency;
}
double relaxation_time() {
  return viscosity() / kFluid.shear_modulus;
}

/// At a rate that keeps the elastic strain at sqrt(2) 0.02 = 0.028.
StartUpRequest request_of(int readings) {
  return {0.02 / relaxation_time(), 5 * relaxation_time(), readings};
}

}  // namespace

Scene couette(Solver solver, int frames) {
  return solver == Solver::kMpm ? shear_box_scene(kFluid, request_of(frames))
                                : particle_shear_box_scene(kFluid, request_of(frames));
}

double couette_stress(const Simulation& simulation, const Scene& scene) {
  return middle_stress(simulation, middle_half(scene)).tau_xy / (viscosity() * request_of(1).rate);
}

double exact_couette_stress(double t) {
  return -std::expm1(-t / relaxation_time());
}

namespace {

/// Largest error over five relaxation times, over the steady stress.
double largest_error(const StartUp& curve) {
  const double steady = viscosity() * curve.rate;
  double worst = 0;
  for (std::size_t i = 0; i < curve.t.size(); ++i)
    worst = std::max(worst, std::abs(curve.stress[i].tau_xy / steady - exact_couette_stress(curve.t[i])));
  return worst;
}

}  // namespace

std::vector<Finding> verify_couette(int threads) {
  const StartUpRequest request = request_of(40);
  // Both integrate at first order: a step of d in shear is d/0.02 relaxation times, and the stress is late by
  // half a step, at most 0.5 d/0.02: 0.25 % for the law's 1e-4, 1.7 % for the box's 6.7e-4.
  return {{"stress by the law, largest error over the steady stress",
           largest_error(start_up(kFluid, request)), 0.004},
          {"stress in the box, largest error over the steady stress",
           largest_error(start_up_in_box(kFluid, request, threads)), 0.02},
          {"stress in the box of the particle method, largest error over the steady stress",
           largest_error(start_up_in_box(kFluid, request, threads, Solver::kMlsrk)), 0.02}};
}

}  // namespace lather::study
