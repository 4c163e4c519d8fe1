#include "sim/study/flow_models.h"

#include <cmath>

namespace lather::study {

PowerLaw power_law(const HerschelBulkleyParameters& law) {
  return {law.yield_stress / std::sqrt(3.0), law.viscosity * std::exp2(-0.5 * (1 + law.flow_index)),
          law.flow_index};
}

void set_flow(HerschelBulkleyParameters& law, const PowerLaw& measured) {
  law.yield_stress = std::sqrt(3.0) * measured.yield_stress;
  law.viscosity = std::exp2(0.5 * (1 + measured.flow_index)) * measured.consistency;
  law.flow_index = measured.flow_index;
}

double stress_at(const PowerLaw& law, double rate) {
  return law.yield_stress + law.consistency * std::pow(rate, law.flow_index);
}

double effective_viscosity(const HerschelBulkleyParameters& law, double excess) {
  if (law.viscosity == 0) return 0;
  const double inverse_index = 1 / law.flow_index;
  return law.viscosity * std::pow(excess / law.viscosity, 1 - inverse_index);
}

double effective_viscosity(const BargteilModel& model, double s) {
  return s / model.flow_rate;
}

BargteilModel bargteil_through(double s, double viscosity) {
  return {s / viscosity};
}

ViscosityComparison compare_viscosities(const HerschelBulkleyParameters& law,
                                        const std::vector<SteadyFlow>& curve) {
  const double yield_radius = std::sqrt(2.0 / 3.0) * law.yield_stress;
  ViscosityComparison out;
  for (const SteadyFlow& flow : curve)
    out.herschel_bulkley.push_back(effective_viscosity(law, flow.stress.s - yield_radius));
  const std::size_t middle = curve.size() / 2;
  const BargteilModel bargteil = bargteil_through(curve[middle].stress.s, out.herschel_bulkley[middle]);
  out.matched_rate = curve[middle].rate;
  out.viscoplastic.assign(curve.size(), out.herschel_bulkley[middle]);
  for (const SteadyFlow& flow : curve) out.bargteil.push_back(effective_viscosity(bargteil, flow.stress.s));
  return out;
}

}  // namespace lather::study
