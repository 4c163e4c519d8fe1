#pragma once

#include <string>
#include <vector>

#include "sim/study/rheometer.h"

/// Closed forms beside the virtual rheometer's curves.
namespace lather::study {

/// A flow curve in the words of rheologists: tau = yield_stress + consistency rate^flow_index, of shear.
struct PowerLaw {
  double yield_stress = 0;  ///< tau_y, Pa
  double consistency = 0;   ///< K, Pa s^n
  double flow_index = 1;    ///< n, dimensionless
};

/// What the law gives in steady simple shear at small elastic strain (s/mu <= 0.03). With the flow gamma(s) =
/// rate/sqrt(2) and s = sqrt(2) tau_xy of simple shear, [Foam eq. 3, 7] become
///
///   tau_y = sigma_Y / sqrt(3),   K = eta 2^(-(1+h)/2),   n = h.
[[nodiscard]] PowerLaw power_law(const HerschelBulkleyParameters& law);

/// The law's parameters for a measured flow curve, the inverse: sigma_Y = sqrt(3) tau_y, eta = 2^((1+n)/2) K.
/// Density and moduli are left as they stand in `law`.
void set_flow(HerschelBulkleyParameters& law, const PowerLaw& measured);

/// Reads "18:12:0.4", tau_y:K:n as measured. Throws InputError.
[[nodiscard]] PowerLaw read_power_law(const std::string& text);

/// tau = tau_y + K rate^n, Pa.
[[nodiscard]] double stress_at(const PowerLaw& law, double rate);

/// Viscosity that a Bingham fluid would need to flow as fast at the excess stress Phi = s - sqrt(2/3)
/// sigma_Y: Phi / (Phi/eta)^(1/h) = eta^(1/h) Phi^(1 - 1/h), Pa s [Foam eq. 7 and below, Fig. 5]. Infinite at
/// or below yield for h > 1.
[[nodiscard]] double effective_viscosity(const HerschelBulkleyParameters& law, double excess);

/// The plastic flow of Bargteil et al. 2007, gamma = nu (|P| - P_y)/|P|, without its limit of 1 a step and
/// without hardening: its effective viscosity is |P|/nu, which grows with stress [Foam Appendix A].
struct BargteilModel {
  double flow_rate = 1;  ///< nu, 1/s
};

/// Effective viscosity at the stress norm `s` (Pa), Pa s.
[[nodiscard]] double effective_viscosity(const BargteilModel& model, double s);

/// The model that has the effective viscosity `viscosity` (Pa s) at the stress norm `s` (Pa).
[[nodiscard]] BargteilModel bargteil_through(double s, double viscosity);

/// Three plasticity models side by side, as in [Foam Fig. 5], at the stresses of a flow curve. The other two
/// are made to flow as fast as the material at its middle rate.
struct ViscosityComparison {
  double matched_rate = 0;               ///< 1/s
  std::vector<double> herschel_bulkley;  ///< Pa s
  std::vector<double> viscoplastic;      ///< a Bingham fluid: the same at every stress
  std::vector<double> bargteil;
};

[[nodiscard]] ViscosityComparison compare_viscosities(const HerschelBulkleyParameters& law,
                                                      const std::vector<SteadyFlow>& curve);

}  // namespace lather::study
