#include "sim/study/flow_models.h"

#include <algorithm>
#include <cmath>

#include "sim/error.h"
#include "sim/study/colon_numbers.h"

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

PowerLaw read_power_law(const std::string& text) {
  const std::vector<double> numbers = numbers_between_colons(text);
  const auto usable = [](double x) { return x >= 0 && std::isfinite(x); };
  if (numbers.size() != 3 || !std::all_of(numbers.begin(), numbers.end(), usable) || numbers[2] == 0)
    throw InputError(
        {{"", "--measured " + text,
          "YIELD:CONSISTENCY:INDEX of tau = YIELD + CONSISTENCY rate^INDEX in Pa and Pa s^INDEX, "
          "none negative, the index above 0, e.g. 18:12:0.4",
          "This is no flow curve."}});
  return {numbers[0], numbers[1], numbers[2]};
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
