// The law at single points against slow twins.
//
// Return mapping: s - s_pre = -2 mu~ dt ((s - y)/eta)^(1/h) [Foam eq. 15] is solved by bisection in extended
// precision, on the logarithm of the unknown, over all magnitudes that scenes reach.
//
// Start-up of shear: the continuous law, b' = l b + b l^T - 2/3 tr(b) gamma(s) s/|s| [Foam eq. 9] with det b
// kept at 1, integrated by Runge-Kutta's fourth-order method in steps of 1e-5 in shear.

#include "sim/study/verify/law.h"

#include <algorithm>
#include <cmath>

#include "sim/material/herschel_bulkley_make.h"
#include "sim/mpm/levels.h"
#include "sim/scene/material_cards.h"
#include "sim/study/rheometer.h"

namespace lather::study {
namespace {

/// x = (s - y)/(s_pre - y): the root of x + K x^(1/h) = 1, by bisection on ln x.
double bisected_excess(double excess_pre, double two_mu_dt, double eta, double h) {
  const long double ln_k = std::log(static_cast<long double>(two_mu_dt) / excess_pre) +
                           std::log(static_cast<long double>(excess_pre) / eta) / h;
  long double low = -5000;
  long double high = 0;
  for (int i = 0; i < 200; ++i) {
    const long double middle = 0.5L * (low + high);
    const bool above = std::exp(middle) + std::exp(ln_k + middle / h) > 1;
    (above ? high : low) = middle;
  }
  return static_cast<double>(std::exp(0.5L * (low + high)) * excess_pre);
}

double return_map_error() {
  const auto& kernels = mpm::kernel_table<double>(best_kernel_level()).point;
  double worst = 0;
  for (const double h : {0.22, 0.43, 1.0, 2.8})
    for (const double eta : {0.1, 10.0, 1000.0})
      for (int decade = -6; decade <= 6; decade += 2)
        for (const double two_mu_dt : {1e-4, 1e-2, 1.0, 100.0}) {
          const double excess_pre = std::pow(10, decade);
          const auto law = herschel_bulkley_constants<double>({1, 1, 1, 0, eta, h});
          double got = 0;
          kernels.plastic_excess(law, &excess_pre, &two_mu_dt, 1, &got);
          const double want = bisected_excess(excess_pre, two_mu_dt, eta, h);
          if (want > 0) worst = std::max(worst, std::abs(got / want - 1));
        }
  return worst;
}

/// b = I + B in simple shear: xx, yy, zz, xy.
using Strain = Eigen::Vector4d;

double deviator_norm(const Strain& b) {
  const double p = (b[0] + b[1] + b[2]) / 3;
  return std::sqrt((b.head<3>().array() - p).square().sum() + 2 * b[3] * b[3]);
}

/// b' at the shear rate `rate`.
Strain strain_rate(const HerschelBulkleyParameters& law, double rate, const Strain& b) {
  Strain change(2 * rate * b[3], 0, 0, rate * b[1]);
  const double norm = deviator_norm(b);
  const double excess = law.shear_modulus * norm - std::sqrt(2.0 / 3.0) * law.yield_stress;
  if (excess <= 0) return change;
  const double trace = b[0] + b[1] + b[2];
  const double flow = std::pow(excess / law.viscosity, 1 / law.flow_index);
  Strain plastic = b;
  plastic.head<3>().array() -= trace / 3;
  plastic *= -2.0 / 3.0 * trace * flow / norm;
  // The flow changes det b at the rate det b tr(b^-1 b'); scaling b to det b = 1 takes a third of it back.
  const double plane = b[0] * b[1] - b[3] * b[3];
  const double growth =
      (b[1] * plastic[0] + b[0] * plastic[1] - 2 * b[3] * plastic[3]) / plane + plastic[2] / b[2];
  return change + plastic - growth / 3 * b;
}

StartUp integrated(const HerschelBulkleyParameters& law, const StartUpRequest& request) {
  const double interval = request.time / request.steps;
  const int steps = static_cast<int>(std::ceil(interval * request.rate / 1e-5));
  const double dt = interval / steps;
  Strain b(1, 1, 1, 0);
  StartUp out;
  for (int i = 0; i <= request.steps; ++i) {
    const double tau[6] = {law.shear_modulus * b[0],
                           law.shear_modulus * b[1],
                           law.shear_modulus * b[2],
                           law.shear_modulus * b[3],
                           0,
                           0};
    out.stress.push_back(shear_stress(tau));
    for (int n = 0; n < steps; ++n) {
      const Strain k1 = strain_rate(law, request.rate, b);
      const Strain k2 = strain_rate(law, request.rate, b + 0.5 * dt * k1);
      const Strain k3 = strain_rate(law, request.rate, b + 0.5 * dt * k2);
      const Strain k4 = strain_rate(law, request.rate, b + dt * k3);
      b += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
  }
  return out;
}

/// Largest error of tau_xy, N1 and s over the curve, over its largest s.
double start_up_error(const HerschelBulkleyParameters& law) {
  const StartUpRequest request = {1, 1, 50};
  const StartUp got = start_up(law, request);
  const StartUp want = integrated(law, request);
  double worst = 0;
  double largest = 0;
  for (std::size_t i = 0; i < got.stress.size(); ++i) {
    const ShearStress& a = got.stress[i];
    const ShearStress& b = want.stress[i];
    largest = std::max(largest, b.s);
    worst = std::max({worst, std::abs(a.tau_xy - b.tau_xy), std::abs(a.n1 - b.n1), std::abs(a.s - b.s)});
  }
  return worst / largest;
}

}  // namespace

std::vector<Finding> verify_law(int /*threads*/) {
  // The return mapping stops Newton's method when the next change is under rounding; exp and log of exponents
  // up to 1/0.22 times logarithms of about 40 cost some 100 units of rounding.
  std::vector<Finding> findings = {{"return mapping, 336 cases, relative", return_map_error(), 1e-12}};
  // The law's step of 1e-4 in shear is of first order: an error of some 1e-4.
  for (const char* name : {"shaving-cream", "smore-interior", "pie"})
    findings.push_back({std::string("start-up of ") + name + " at 1/s, largest error over s",
                        start_up_error(find_material_card(name)->parameters), 3e-4});
  return findings;
}

}  // namespace lather::study
