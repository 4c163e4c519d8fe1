#include "sim/study/rheometer_json.h"

#include "sim/scene/value.h"

namespace lather::study {
namespace {

Value numbers(const std::vector<double>& values) {
  Array array;
  for (const double v : values) array.emplace_back(v);
  return Value(std::move(array));
}

template <class List, class Access>
Value numbers_of(const List& list, const Access& access) {
  std::vector<double> values;
  for (const auto& element : list) values.push_back(access(element));
  return numbers(values);
}

template <class List, class StressOf>
void add_stresses(Object& out, const List& list, const StressOf& stress_of) {
  out.emplace_back("tau_xy", numbers_of(list, [&](const auto& e) { return stress_of(e).tau_xy; }));
  out.emplace_back("n1", numbers_of(list, [&](const auto& e) { return stress_of(e).n1; }));
  out.emplace_back("s", numbers_of(list, [&](const auto& e) { return stress_of(e).s; }));
}

}  // namespace

std::string to_json(const StartUp& curve) {
  Object out = {{"t", numbers(curve.t)}};
  add_stresses(out, curve.stress, [](const ShearStress& s) { return s; });
  return write_json(out);
}

std::string to_json(const HerschelBulkleyParameters& law, const std::vector<SteadyFlow>& curve,
                    const std::optional<PowerLaw>& measured) {
  const PowerLaw power = power_law(law);
  const ViscosityComparison viscosity = compare_viscosities(law, curve);
  Object out = {{"rate", numbers_of(curve, [](const SteadyFlow& f) { return f.rate; })}};
  add_stresses(out, curve, [](const SteadyFlow& f) { return f.stress; });
  out.emplace_back("power_law",
                   numbers_of(curve, [&](const SteadyFlow& f) { return stress_at(power, f.rate); }));
  Array steady;
  for (const SteadyFlow& f : curve) steady.emplace_back(f.steady);
  out.emplace_back("steady", std::move(steady));
  out.emplace_back("effective_viscosity", Object{{"matched_rate", viscosity.matched_rate},
                                                 {"herschel_bulkley", numbers(viscosity.herschel_bulkley)},
                                                 {"viscoplastic", numbers(viscosity.viscoplastic)},
                                                 {"bargteil", numbers(viscosity.bargteil)}});
  if (measured) {
    out.emplace_back("measured",
                     numbers_of(curve, [&](const SteadyFlow& f) { return stress_at(*measured, f.rate); }));
    HerschelBulkleyParameters same;
    set_flow(same, *measured);
    out.emplace_back("measured_parameters", Object{{"yield_stress", same.yield_stress},
                                                   {"viscosity", same.viscosity},
                                                   {"flow_index", same.flow_index}});
  }
  return write_json(out);
}

}  // namespace lather::study
