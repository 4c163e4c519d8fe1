#include "sim/scene/models.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

Codec<double> density() {
  return number("kg/m^3", from_to(1e-3, 1e5));
}
Codec<double> modulus() {
  return number("Pa", from_to(1e-3, 1e13));
}

template <class P>
std::vector<Field<P>> elastic_fields() {
  return {required<P>(
              "density", [](auto& p) -> auto& { return p.elastic.density; }, density(),
              "mass per volume at rest"),
          required<P>(
              "youngs_modulus", [](auto& p) -> auto& { return p.elastic.youngs_modulus; }, modulus(),
              "E: stiffness against being pulled"),
          required<P>(
              "poisson_ratio", [](auto& p) -> auto& { return p.elastic.poisson_ratio; },
              number("1", from_to(0, 0.4999)),
              "nu: how much it narrows when pulled; near 0.5 it hardly changes its volume")};
}

template <class P>
std::vector<Field<P>> viscous_fields() {
  return {optional<P>(
              "viscosity", [](auto& p) -> auto& { return p.viscous.viscosity; },
              number("Pa s", from_to(0, 1e9)), "mu_v: resistance to the rate of change of form"),
          optional<P>(
              "bulk_viscosity", [](auto& p) -> auto& { return p.viscous.bulk_viscosity; },
              number("Pa s", from_to(0, 1e9)), "zeta_v: resistance to the rate of change of volume")};
}

template <class P>
std::vector<Field<P>> joined(std::vector<std::vector<Field<P>>> parts) {
  std::vector<Field<P>> out;
  for (std::vector<Field<P>>& part : parts) out.insert(out.end(), part.begin(), part.end());
  return out;
}

template <class P>
Field<P> hardening(const char* meaning) {
  return optional<P>("hardening", &P::hardening, number("1", from_to(0, 1e3)), meaning);
}

template <class P>
Model model(const Table<P>& table) {
  return {table.info().title, table.info(), table.prototype(),
          [&table](const Value& value, Law& law, const Place& place, bool complete) {
            return table.read_fields(value, std::get<P>(law), place, complete);
          },
          [&table](const Law& law, Object& out) { table.write_fields(std::get<P>(law), out); }};
}

}  // namespace

const Table<HerschelBulkleyParameters>& herschel_bulkley() {
  using P = HerschelBulkleyParameters;
  P elastic;
  elastic.yield_stress = kInfinity;
  static const Table<P> table(
      "herschel-bulkley",
      "Elasto-viscoplastic foam. Perfectly plastic with viscosity 0, Bingham with flow_index 1, elastic with "
      "an infinite yield_stress. The first three keys are required where no preset is named.",
      {required<P>("density", &P::density, density(), "mass per volume at rest"),
       required<P>("bulk_modulus", &P::bulk_modulus, modulus(), "stiffness against change of volume"),
       required<P>("shear_modulus", &P::shear_modulus, number("Pa", from_to(1e-6, 1e15)),
                   "stiffness against change of form"),
       optional<P>("yield_stress", &P::yield_stress, number_or_infinity("Pa", from_to(0, 1e13)),
                   "sigma_Y: plastic flow starts where the shear stress norm reaches sqrt(2/3) of it"),
       optional<P>("viscosity", &P::viscosity, number("Pa s^h", from_to(0, 1e9)),
                   "eta: resistance of the plastic flow; h is the flow_index"),
       optional<P>("flow_index", &P::flow_index, number("1", from_to(0.05, 10)),
                   "h: below 1 the material thins under shear, above 1 it thickens")},
      elastic);
  return table;
}

const Table<NeoHookeanParameters>& neo_hookean() {
  using P = NeoHookeanParameters;
  static const Table<P> table("neo-hookean",
                              "A solid that springs back: rubber, jelly, flesh; perhaps viscous.",
                              joined<P>({elastic_fields<P>(), viscous_fields<P>()}));
  return table;
}

const Table<DruckerPragerParameters>& drucker_prager() {
  using P = DruckerPragerParameters;
  static const Table<P> table(
      "drucker-prager",
      "A solid that bears as much shear as friction under its pressure allows: sand, powder, brittle things. "
      "Without friction and cohesion a fluid.",
      joined<P>(
          {elastic_fields<P>(),
           viscous_fields<P>(),
           {required<P>("friction_angle_deg", &P::friction_angle_deg, number("degrees", from_to(0, 89)),
                        "phi_f: angle of internal friction"),
            optional<P>(
                "friction_match", &P::match,
                enumeration<FrictionMatch>({{"triaxial-compression", FrictionMatch::kTriaxialCompression},
                                            {"plane-strain", FrictionMatch::kPlaneStrain}}),
                "the loading under which friction_angle_deg holds; matched to triaxial compression, 30 "
                "degrees act as 43.9 in plane strain in 3D and as 27.5 in 2D"),
            optional<P>("cohesion", &P::cohesion, number("1", from_to(0, 100)),
                        "eps_c: logarithmic strain that it bears in tension"),
            hardening<P>(
                "xi: moduli grow by exp(xi (1 - Jp)) as it is compacted; Jp is the plastic change of "
                "volume")}}));
  return table;
}

const Table<SnowParameters>& snow() {
  using P = SnowParameters;
  static const Table<P> table(
      "snow",
      "A solid whose stretches beyond critical ones stay: packed snow, hard where compacted, brittle where "
      "loose.",
      joined<P>(
          {elastic_fields<P>(),
           {optional<P>("critical_compression", &P::critical_compression, number("1", {0, 1, false, true}),
                        "theta_c: stretches stay elastic from 1 - theta_c"),
            optional<P>("critical_stretch", &P::critical_stretch, number("1", from_to(0, 100)),
                        "theta_s: stretches stay elastic to 1 + theta_s"),
            hardening<P>("xi: moduli grow by exp(xi (1 - Jp)); Jp is the plastic change of volume")}}));
  return table;
}

const Table<LiquidParameters>& liquid() {
  using P = LiquidParameters;
  static const Table<P> table(
      "liquid",
      "A weakly compressible liquid: pressure K/gamma (J^-gamma - 1), never below 0, and Newtonian "
      "viscosity.",
      joined<P>(
          {{required<P>("density", &P::density, density(), "mass per volume at rest"),
            required<P>("bulk_modulus", &P::bulk_modulus, modulus(),
                        "K: stiffness against change of volume; the speed of sound is sqrt(K / density)"),
            optional<P>("exponent", &P::exponent, number("1", from_to(1, 100)),
                        "gamma: how fast pressure grows with compression")},
           viscous_fields<P>()}));
  return table;
}

const std::vector<Model>& models() {
  static const std::vector<Model> all = {model(herschel_bulkley()), model(neo_hookean()),
                                         model(drucker_prager()), model(snow()), model(liquid())};
  static_assert(std::variant_size_v<Law> == 5, "every law has its table here, in the order of Law");
  return all;
}

const Model& model_of(const Law& law) {
  return models()[law.index()];
}

const Model& default_model() {
  return models().front();
}

}  // namespace lather::tables
