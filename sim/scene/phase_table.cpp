#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

constexpr std::size_t kMaxParameters = 16;
constexpr std::size_t kMaxCurvePoints = 256;
constexpr double kMaxValue = 1e13;

Codec<double> concentration() {
  return number("1", from_to(0, 1));
}
Codec<double> parameter() {
  return number("that of the parameter", from_to(-kMaxValue, kMaxValue));
}

Table<Smoothstep> smoothstep_table() {
  using S = Smoothstep;
  return {"smoothstep",
          "`start` up to the concentration `from`, `end` beyond `to`, in between start + (end - start) u^2 "
          "(3 - 2u).",
          {required<S>("from", &S::from, concentration(), "concentration at which the change begins"),
           required<S>("to", &S::to, concentration(), "concentration at which it ends; above `from`"),
           required<S>("start", &S::start, parameter(), "value up to `from`"),
           required<S>("end", &S::end, parameter(), "value beyond `to`")},
          {},
          [](const Value& value, S& s, const Place& place) {
            if (s.to > s.from) return;
            place.at("to").refuse(value.find("to"), "above from, " + write_json(s.from),
                                  "The change ends before it begins.");
          }};
}

/// [concentration, value]
Codec<CurvePoint> curve_point() {
  const Codec<double> at = concentration();
  const Codec<double> of = parameter();
  Codec<CurvePoint> codec;
  codec.allowed = "2 numbers: a concentration " + at.allowed + ", and a value " + of.allowed;
  codec.schema = {{"type", "array"},
                  {"prefixItems", Array{at.schema, of.schema}},
                  {"items", false},
                  {"minItems", std::int64_t{2}}};
  codec.read = [at, of, allowed = codec.allowed](const Value& value, CurvePoint& out, const Place& place) {
    const Array* pair = value.array();
    if (pair == nullptr || pair->size() != 2)
      return place.refuse(value, allowed, "This must be a pair of numbers.");
    const bool good = at.read((*pair)[0], out.concentration, place.at(0));
    return of.read((*pair)[1], out.value, place.at(1)) && good;
  };
  codec.write = [](const CurvePoint& p) { return Value(Array{p.concentration, p.value}); };
  return codec;
}

Table<CurveTable> curve_table() {
  return {"table",
          "Straight lines between points; the outermost values beyond them.",
          {required<CurveTable>("points", &CurveTable::points,
                                list_of(curve_point(), 1, kMaxCurvePoints, "pairs [concentration, value]"),
                                "by ascending concentration")},
          {},
          [](const Value& value, CurveTable& t, const Place& place) {
            for (std::size_t i = 1; i < t.points.size(); ++i) {
              if (t.points[i].concentration > t.points[i - 1].concentration) continue;
              place.at("points").at(i).at(0).refuse((*(*value.find("points")->array())[i].array())[0],
                                                    "above " + write_json(t.points[i - 1].concentration),
                                                    "Points must ascend in concentration.");
            }
          }};
}

Table<CurvePolynomial> polynomial_table() {
  return {"polynomial",
          "a_0 + a_1 c + a_2 c^2 + …",
          {required<CurvePolynomial>("coefficients", &CurvePolynomial::coefficients,
                                     list_of(parameter(), 1, 8, "numbers"), "a_0, a_1, a_2, …")}};
}

using Parameters = std::vector<std::pair<std::string, Curve>>;

/// An object of curves; which keys it may have depends on the model, see material_table.cpp.
Codec<Parameters> parameters() {
  const Codec<Curve> curve = curve_codec();
  Codec<Parameters> codec;
  codec.allowed = "an object of at most " + std::to_string(kMaxParameters) + " curves";
  codec.schema = {{"type", "object"},
                  {"additionalProperties", curve.schema},
                  {"maxProperties", static_cast<std::int64_t>(kMaxParameters)}};
  codec.read = [curve, allowed = codec.allowed](const Value& value, Parameters& out, const Place& place) {
    const Object* object = value.object();
    if (object == nullptr) return place.refuse(value, allowed, "This must be an object.");
    if (object->size() > kMaxParameters)
      return place.refuse(value, allowed, "The object has " + std::to_string(object->size()) + " keys.");
    bool good = true;
    out.clear();
    for (const auto& [key, given] : *object) {
      out.emplace_back(key, Curve());
      good = curve.read(given, out.back().second, place.at(key)) && good;
    }
    return good;
  };
  codec.write = [curve](const Parameters& list) {
    Object object;
    for (const auto& [key, c] : list) object.emplace_back(key, curve.write(c));
    return Value(std::move(object));
  };
  return codec;
}

}  // namespace

const Tagged<Curve>& curves() {
  static const Tagged<Curve> tagged(
      {alternative<Curve>("smoothstep", smoothstep_table()), alternative<Curve>("table", curve_table()),
       alternative<Curve>("polynomial", polynomial_table())},
      {});
  return tagged;
}

Codec<Curve> curve_codec() {
  Codec<Curve> codec;
  codec.allowed = "an object, see curves";
  codec.schema = {{"$ref", "#/$defs/curve"}};
  codec.read = [](const Value& value, Curve& out, const Place& place) {
    return curves().read(value, out, place);
  };
  codec.write = [](const Curve& c) { return Value(curves().write(c)); };
  return codec;
}

const Table<Phase>& phase() {
  static const Table<Phase> table(
      "phase",
      "A material with a phase carries a concentration that diffuses between its points and those of other "
      "materials with one (solver \"mlsrk\").",
      {required<Phase>("concentration", &Phase::concentration, concentration(),
                       "c at t = 0: the mass of one component (water, say) over all mass"),
       required<Phase>("mobility", &Phase::mobility, number("m^2/s", from_to(0, 1e3)),
                       "L: where everything mixes, c diffuses with 2 L"),
       optional<Phase>("by_concentration", &Phase::by_concentration, parameters(),
                       "parameters of the model that change with c, each by its key and a curve, which takes "
                       "the key's place; with a \"density\", material swells or shrinks to it")});
  return table;
}

const Table<PhaseNumerics>& phase_numerics() {
  using P = PhaseNumerics;
  static const Table<P> table = [] {
    Field<P> width;
    const Codec<double> length = number("m", from_to(0, kMaxLength));
    width.info = {"interface_width",
                  "epsilon: how wide an interface is; 0 saves its computation",
                  Presence::kOptional,
                  length.unit,
                  length.allowed,
                  length.schema,
                  {},
                  "half the support radius"};
    width.read = [length](const Value& value, P& p, const Place& place) {
      return length.read(value, p.interface_width.emplace(), place);
    };
    width.write = [](const P& p) {
      return p.interface_width ? std::optional<Value>(*p.interface_width) : std::nullopt;
    };
    return Table<P>(
        "phases", "How concentrations are computed; only materials with a \"phase\" have one.",
        {width,
         optional<P>(
             "balance", &P::balance,
             enumeration<PhaseBalance>({{"mass", PhaseBalance::kMass},
                                        {"lumped-mass", PhaseBalance::kLumpedMass},
                                        {"concentration", PhaseBalance::kConcentration}}),
             "what is balanced between points: a component's mass over the points' own, which keeps "
             "it to rounding; over lumped ones; or the concentration itself, which does not keep mass"),
         optional<P>("free_energy", &P::free_energy,
                     enumeration<FreeEnergy>(
                         {{"diffusion", FreeEnergy::kDiffusion}, {"double-well", FreeEnergy::kDoubleWell}}),
                     "(c - 1/2)^2, by which all mixes, or c^2 (1 - c)^2, by which components part")});
  }();
  return table;
}

}  // namespace lather::tables
