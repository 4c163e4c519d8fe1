#include "tests/support/feature_scenes.h"

#include "tests/support/law_scenes.h"

namespace lather::testing_support {
namespace {

/// A block of one material over a floor, some hundred points, 0.02 s; `law` are keys of the material, `more`
/// of the scene.
std::string block(const std::string& law, const std::string& more) {
  return R"({"lather": 1, "name": "block", "duration": 0.02, "frame_rate": 100, "spacing": 0.02,
    "domain": {"min": [0, 0, 0], "max": [0.32, 0.32, 0.32]},
    "materials": [{"name": "m", )" +
         law + R"(}],
    "bodies": [{"name": "block", "material": "m", "velocity": [0, -1, 0],
                "shape": {"type": "box", "size": [0.08, 0.08, 0.08], "translate": [0.16, 0.08, 0.16]}}],
    "obstacles": [{"name": "peg", "shape": {"type": "sphere", "radius": 0.03, "translate": [0.16, 0, 0.16]}}])" +
         more + "}";
}

const std::string kFoam =
    R"("density": 100, "bulk_modulus": 1e4, "shear_modulus": 1e3, "yield_stress": 10, "viscosity": 1,
       "flow_index": 0.5)";
const std::string kTearing = kFoam + R"(, "tear_threshold": 0.5)";
const std::string kParticles = R"(, "solver": "mlsrk")";
const std::string kPhase = R"(, "phase": {"concentration": 0.5, "mobility": 1e-4})";

}  // namespace

const std::vector<FeatureScene>& feature_scenes() {
  const std::string deformation = "deformation F - I";
  static const std::vector<FeatureScene> all = {
      {"tearing",
       block(kFoam, ""),
       {{"/materials/0/tear_threshold", "0.5"}},
       {{"/materials/0/tear_threshold", "\"infinity\""}},
       {deformation, "plasticity |dev Cp|"},
       {"detect tearing", "limit forces", "limit deformation"}},
      {"recovery",
       block(kTearing, ""),
       {{"/materials/0/recovery_time", "1"}},
       {{"/materials/0/recovery_time", "\"infinity\""}},
       {},
       {"plastic recovery"}},
      {"removal",
       block(kTearing, ""),
       {{"/numerics/subgrid_removal", "{}"}},
       {{"/numerics/subgrid_removal", "null"}},
       {},
       {"remove subgrid geometry"}},
      {"resampling",
       block(kFoam, ""),
       {{"/numerics/resampling", "{}"}},
       {{"/numerics/resampling", "null"}},
       {"share of mass"},
       {"avoid a void"}},
      {"phases",
       block(kJelly, kParticles),
       {{"/materials/0/phase", R"({"concentration": 0.5, "mobility": 1e-4})"}},
       {{"/materials/0/phase", "null"}},
       {"concentration"},
       {"phases"}},
      {"swelling",
       block(kJelly + kPhase, kParticles),
       {{"/materials/0/phase/by_concentration",
         R"({"density": {"type": "table", "points": [[0, 800], [1, 1000]]}})"},
        {"/materials/0/density", "null"}},
       {{"/materials/0/phase/by_concentration", "{}"}, {"/materials/0/density", "1000"}},
       {},
       {}},
      {"viscosity",
       block(kWater, kParticles),
       {{"/materials/0/viscosity", "1"}},
       {{"/materials/0/viscosity", "0"}},
       {"velocity gradient"},
       {}},
      {"hardening",
       block(kSand, kParticles),
       {{"/materials/0/hardening", "5"}},
       {{"/materials/0/hardening", "0"}},
       {},
       {}},
      {"periodic axes",
       block(kFoam, ""),
       {{"/domain/periodic", "[true, false, true]"}},
       {{"/domain/periodic", "[false, false, false]"}},
       {},
       {}},
      {"moving obstacles",
       block(kFoam, ""),
       {{"/obstacles/0/motion", R"({"type": "linear", "velocity": [0.1, 0, 0]})"}},
       {{"/obstacles/0/motion", R"({"type": "rest"})"}},
       {},
       {}},
      {"skin",
       block(kFoam, ""),
       {{"/look/style", "\"skin\""}, {"/output/skin", "[\"ply\"]"}},
       {{"/look/style", "\"points\""}, {"/output/skin", "[]"}},
       {},
       {}}};
  return all;
}

Scene minimal_scene(const FeatureScene& feature) {
  return parse_scene(feature.minimal);
}

Scene scene_with(const FeatureScene& feature) {
  return parse_scene(feature.minimal, "", feature.with);
}

Scene scene_without(const FeatureScene& feature) {
  std::vector<Override> changes = feature.with;
  changes.insert(changes.end(), feature.absent.begin(), feature.absent.end());
  return parse_scene(feature.minimal, "", changes);
}

}  // namespace lather::testing_support
