#include "tests/support/reference_data.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace lather::testing_support {
namespace {

nlohmann::json load(const std::string& name) {
  std::ifstream file(std::string(LATHER_TEST_DATA) + "/" + name);
  if (!file) throw std::runtime_error("cannot open " + name);
  return nlohmann::json::parse(file);
}

/// A tensor of dimension rows, completed to plane strain.
Mat9 plane_strain(const nlohmann::json& rows, std::size_t dimension) {
  Mat9 m = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (std::size_t i = 0; i < dimension; ++i)
    for (std::size_t j = 0; j < dimension; ++j) m[3 * i + j] = rows.at(i).at(j);
  return m;
}

PlasticCase plastic_case(const nlohmann::json& c) {
  const int dimension = c.at("dimension");
  const auto rows = static_cast<std::size_t>(dimension);
  return {dimension, plane_strain(c.at("F_e_trial"), rows), c.at("J_p").get<double>() - 1,
          plane_strain(c.at("F_e"), rows), c.at("J_p_new").get<double>() - 1};
}

}  // namespace

std::vector<ReturnMapCase> return_map_cases() {
  std::vector<ReturnMapCase> cases;
  const nlohmann::json data = load("hb_return_map.json");
  for (const auto& c : data.at("cases"))
    cases.push_back({c.at("s_pre"), c.at("mu_tilde_dt"), c.at("sigma_y"), c.at("eta"), c.at("h"),
                     std::stod(c.at("excess").get<std::string>())});
  return cases;
}

std::vector<SimpleShearRun> simple_shear_runs() {
  std::vector<SimpleShearRun> runs;
  const nlohmann::json data = load("hb_simple_shear.json");
  for (const auto& r : data.at("runs"))
    runs.push_back({r.at("mu"), r.at("sigma_y"), r.at("eta"), r.at("h"), r.at("shear_rate"),
                    r.at("t").get<std::vector<double>>(), r.at("tau_xy").get<std::vector<double>>(),
                    r.at("n1").get<std::vector<double>>(), r.at("s").get<std::vector<double>>()});
  return runs;
}

std::vector<TearingCase> tearing_cases() {
  std::vector<TearingCase> cases;
  const nlohmann::json data = load("tearing.json");
  for (const auto& c : data.at("cases")) {
    const auto matrix = [&](const char* key) {
      Mat9 m{};
      for (std::size_t i = 0; i < m.size(); ++i) m[i] = c.at(key).at(i / 3).at(i % 3);
      return m;
    };
    cases.push_back({matrix("F"), matrix("be_bar"), c.at("kappa"), c.at("mu"), c.at("dt"),
                     c.at("recovery_time"), matrix("velocity_gradient"), c.at("plasticity"), matrix("cauchy"),
                     matrix("cauchy_limited"), matrix("f_limited"), matrix("F_limited"),
                     matrix("be_bar_pre_limited"), matrix("F_recovered")});
  }
  return cases;
}

std::vector<DruckerPragerCase> drucker_prager_cases() {
  std::vector<DruckerPragerCase> cases;
  const nlohmann::json data = load("drucker_prager.json");
  for (const auto& c : data.at("cases"))
    cases.push_back({plastic_case(c), c.at("lame_lambda"), c.at("lame_mu"), c.at("friction_angle_deg"),
                     c.at("cohesion"), c.at("case")});
  return cases;
}

std::vector<SnowCase> snow_cases() {
  std::vector<SnowCase> cases;
  const nlohmann::json data = load("snow.json");
  for (const auto& c : data.at("cases"))
    cases.push_back(
        {plastic_case(c), c.at("theta_c"), c.at("theta_s"), c.at("hardening"), c.at("stiffness_factor")});
  return cases;
}

HerschelBulkleyParameters SimpleShearRun::law() const {
  // Density and bulk modulus do not enter; those of shaving cream.
  return {77.7, 109e3, mu, sigma_y, eta, h};
}

double SimpleShearRun::largest_s() const {
  return *std::max_element(s.begin(), s.end());
}

std::string SimpleShearRun::name() const {
  std::ostringstream out;
  out << "mu " << mu << " sigma_Y " << sigma_y << " eta " << eta << " h " << h << " at " << shear_rate
      << "/s";
  return out.str();
}

}  // namespace lather::testing_support
