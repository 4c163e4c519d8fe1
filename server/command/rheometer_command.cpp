#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>

#include "render/chart.h"
#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/scene/material_cards.h"
#include "sim/scene/models.h"
#include "sim/scene/read_material.h"
#include "sim/study/flow_models.h"
#include "sim/study/rheometer.h"
#include "sim/study/rheometer_json.h"
#include "sim/study/shear_box.h"

namespace lather::server {
namespace {

using study::StartUp;
using study::SteadyFlow;

/// A preset by its name, or a file with a material.
Material read_material(const std::string& source) {
  const bool looks_like_file = source.find_first_of("./") != std::string::npos;
  const bool file =
      looks_like_file || (find_material_card(source) == nullptr && std::filesystem::exists(source));
  Material material = file ? parse_material(read_text(source)) : material_from_card(source);
  if (!std::holds_alternative<HerschelBulkleyParameters>(material.law))
    throw InputError({{"/model", tables::model_of(material.law).name, "\"herschel-bulkley\"",
                       "The rheometer shears materials of the model \"herschel-bulkley\" only."}});
  return material;
}

template <class List, class Access>
std::vector<double> column(const List& list, const Access& access) {
  std::vector<double> values;
  for (const auto& element : list) values.push_back(access(element));
  return values;
}

void print_parameters(const Material& material) {
  const HerschelBulkleyParameters& law = material.herschel_bulkley();
  const study::PowerLaw power = study::power_law(law);
  std::printf("%s: shear modulus %.6g Pa, yield stress %.6g Pa, viscosity %.6g Pa s^h, flow index %.6g\n",
              material.name.c_str(), law.shear_modulus, law.yield_stress, law.viscosity, law.flow_index);
  std::printf("at small elastic strain: tau_xy = %.6g Pa + %.6g Pa s^h rate^%.6g\n\n", power.yield_stress,
              power.consistency, power.flow_index);
}

/// At most 21 readings, evenly spaced, with the first and the last; --json has all of them.
void print_table(const StartUp& curve) {
  std::printf("%12s %12s %14s %14s %14s\n", "t (s)", "strain", "tau_xy (Pa)", "N1 (Pa)", "s (Pa)");
  const std::size_t last = curve.t.size() - 1;
  const std::size_t rows = std::min<std::size_t>(last, 20);
  for (std::size_t row = 0; row <= rows; ++row) {
    const std::size_t i = row * last / rows;
    const study::ShearStress& s = curve.stress[i];
    std::printf("%12.6g %12.6g %14.6g %14.6g %14.6g\n", curve.t[i], curve.rate * curve.t[i], s.tau_xy, s.n1,
                s.s);
  }
}

void print_measured(const study::PowerLaw& measured) {
  HerschelBulkleyParameters same;
  study::set_flow(same, measured);
  std::printf(
      "measured: tau_xy = %.6g Pa + %.6g Pa s^n rate^%.6g, which is yield stress %.6g Pa, viscosity "
      "%.6g Pa s^h, flow index %.6g\n\n",
      measured.yield_stress, measured.consistency, measured.flow_index, same.yield_stress, same.viscosity,
      same.flow_index);
}

void print_table(const HerschelBulkleyParameters& law, const std::vector<SteadyFlow>& curve,
                 const std::optional<study::PowerLaw>& measured) {
  const study::PowerLaw power = study::power_law(law);
  const study::ViscosityComparison v = study::compare_viscosities(law, curve);
  std::printf("%12s %12s %12s %12s %12s | %s, Pa s\n", "", "", "", "", "power law",
              "effective viscosity at the stress s");
  std::printf("%12s %12s %12s %12s %12s | %12s %12s %12s%s\n", "rate (1/s)", "tau_xy (Pa)", "N1 (Pa)",
              "s (Pa)", "tau_xy (Pa)", "this law", "viscoplastic", "Bargteil",
              measured ? " | measured, Pa" : "");
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const SteadyFlow& f = curve[i];
    std::printf("%12.6g %12.6g %12.6g %12.6g %12.6g | %12.6g %12.6g %12.6g", f.rate, f.stress.tau_xy,
                f.stress.n1, f.stress.s, study::stress_at(power, f.rate), v.herschel_bulkley[i],
                v.viscoplastic[i], v.bargteil[i]);
    if (measured) std::printf(" | %12.6g", study::stress_at(*measured, f.rate));
    std::printf("%s\n", f.steady ? "" : "  not steady");
  }
  std::printf("\nThe other two models are made to flow as fast as this law at %.6g/s.\n", v.matched_rate);
}

render::Chart chart_of(const Material& material, const StartUp& curve) {
  render::Chart chart;
  chart.title = material.name + ": start-up of shear";
  chart.x.label = "time (s)";
  chart.y.label = "stress (Pa)";
  chart.series = {{"tau_xy", curve.t, column(curve.stress, [](const auto& s) { return s.tau_xy; })},
                  {"N1", curve.t, column(curve.stress, [](const auto& s) { return s.n1; })},
                  {"s", curve.t, column(curve.stress, [](const auto& s) { return s.s; }), true}};
  return chart;
}

render::Chart flow_chart(const Material& material, const std::vector<SteadyFlow>& curve,
                         const std::optional<study::PowerLaw>& measured) {
  const study::PowerLaw power = study::power_law(material.herschel_bulkley());
  const std::vector<double> rates = column(curve, [](const SteadyFlow& f) { return f.rate; });
  render::Chart chart;
  chart.title = material.name + ": steady simple shear";
  chart.x = {"shear rate (1/s)", true};
  chart.y = {"stress (Pa)", true};
  chart.series = {
      {"tau_xy", rates, column(curve, [](const SteadyFlow& f) { return f.stress.tau_xy; })},
      {"N1", rates, column(curve, [](const SteadyFlow& f) { return f.stress.n1; })},
      {"tau_xy, stiff limit", rates,
       column(curve, [&](const SteadyFlow& f) { return study::stress_at(power, f.rate); }), true}};
  if (measured)
    chart.series.push_back({"tau_xy, measured", rates, column(curve, [&](const SteadyFlow& f) {
                              return study::stress_at(*measured, f.rate);
                            })});
  return chart;
}

/// [Foam Fig. 5]
render::Chart viscosity_chart(const Material& material, const std::vector<SteadyFlow>& curve) {
  const study::ViscosityComparison v = study::compare_viscosities(material.herschel_bulkley(), curve);
  const std::vector<double> s = column(curve, [](const SteadyFlow& f) { return f.stress.s; });
  render::Chart chart;
  chart.title = material.name + ": effective viscosity";
  chart.x = {"stress s (Pa)", false};
  chart.y = {"effective viscosity (Pa s)", true};
  chart.series = {{"this law", s, v.herschel_bulkley},
                  {"viscoplastic", s, v.viscoplastic},
                  {"Bargteil et al. 2007", s, v.bargteil}};
  return chart;
}

void write_chart(const std::filesystem::path& file, const render::Chart& chart) {
  if (!file.empty()) write_whole(file, render::to_svg(chart));
}

void check(const RheometerOptions& o) {
  if (!o.chart.empty() && o.chart.extension() != ".svg")
    throw InputError(
        {{"", "--chart " + o.chart.string(), "a file that ends in .svg", "Charts are SVG only."}});
  if (o.rates.empty() && o.viscosity)
    throw InputError(
        {{"", "--viscosity", "with --rates",
          "The effective viscosity belongs to a flow curve; add --rates, e.g. --rates 0.01:100."}});
  if (o.rates.empty() && !o.measured.empty())
    throw InputError({{"", "--measured " + o.measured, "with --rates",
                       "It is a flow curve; add --rates, e.g. --rates 0.01:100, to see the material's beside "
                       "it."}});
  if (!o.rates.empty() && o.box)
    throw InputError({{"", "--box --rates " + o.rates, "one of the two",
                       "A flow curve comes from the law alone; for the box give one rate with --rate."}});
}

int steady_flow(const RheometerOptions& options, const Material& material) {
  const HerschelBulkleyParameters& law = material.herschel_bulkley();
  std::optional<study::PowerLaw> measured;
  if (!options.measured.empty()) measured = study::read_power_law(options.measured);
  const std::vector<SteadyFlow> curve = study::flow_curve(law, study::read_rate_range(options.rates));
  write_chart(options.chart,
              options.viscosity ? viscosity_chart(material, curve) : flow_chart(material, curve, measured));
  if (options.json) {
    std::printf("%s\n", study::to_json(law, curve, measured).c_str());
  } else {
    print_parameters(material);
    if (measured) print_measured(*measured);
    print_table(law, curve, measured);
  }
  return 0;
}

int start_up(const RheometerOptions& options, const Material& material) {
  const HerschelBulkleyParameters& law = material.herschel_bulkley();
  const study::StartUpRequest request = {options.rate, options.time, options.steps};
  const StartUp curve =
      options.box ? study::start_up_in_box(law, request, options.threads) : study::start_up(law, request);
  write_chart(options.chart, chart_of(material, curve));
  if (options.json) {
    std::printf("%s\n", study::to_json(curve).c_str());
  } else {
    print_parameters(material);
    print_table(curve);
  }
  return 0;
}

}  // namespace

int rheometer_command(const RheometerOptions& options) {
  check(options);
  const Material material = read_material(options.material);
  return options.rates.empty() ? start_up(options, material) : steady_flow(options, material);
}

}  // namespace lather::server
