#include "sim/scene/solver_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/scene/tables.h"

namespace lather {
namespace {

using descriptor::Place;

constexpr const char* kTurnToMpm = "set \"solver\" to \"mpm\"";

/// What the grid solver does with Herschel-Bulkley materials alone, where the scene has others as well.
void check_foam_only(const Value& document, const Scene& scene, const Place& numerics) {
  const std::string& foam = tables::default_model().name;
  const auto other = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [&](const Material& m) { return tables::model_of(m.law).name != foam; });
  if (other == scene.materials.end()) return;
  const Value* given = document.find("numerics");
  const auto refuse = [&](const char* key, const std::string& allowed, const std::string& what) {
    numerics.at(key).refuse(given != nullptr ? given->find(key) : nullptr, allowed + " beside other models",
                            what + " of the model \"" + foam + "\" only, and \"" + other->name +
                                "\" is of the model \"" + tables::model_of(other->law).name + "\". Take \"" +
                                key + "\" out.");
  };
  if (scene.numerics.integration != Integration::kExplicit)
    refuse("integration", "\"explicit\"", "Semi-implicit steps know the stiffness of materials");
  if (scene.numerics.resampling)
    refuse("resampling", "null, or left out,", "Resampling inserts and merges points of materials");
}

void check_no_phases_in_mpm(const Scene& scene, const Place& materials) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].phase)
      materials.at(i).at("phase").refuse(
          nullptr, "null, or left out, with \"solver\": \"mpm\"",
          "The solver \"mpm\" knows no concentrations. Take \"phase\" out, or set \"solver\" to \"mlsrk\".");
}

void check_no_tearing(const Scene& scene, const Place& materials) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const double threshold = scene.materials[i].tearing.tear_threshold;
    if (std::isinf(threshold)) continue;
    materials.at(i)
        .at("tear_threshold")
        .refuse(Value(threshold), "\"infinity\" with \"solver\": \"mlsrk\"",
                std::string("The solver \"mlsrk\" does not tear materials") +
                    (scene.materials[i].preset.empty() ? "" : ", and the preset gives a threshold") +
                    ". Set \"tear_threshold\" to \"infinity\", or " + kTurnToMpm + ".");
  }
}

void check_no_mpm_numerics(const Value& document, const Scene& scene, const Place& root) {
  const Value* given = document.find("numerics");
  const auto refuse = [&](const char* key, const std::string& allowed, const std::string& message) {
    root.at("numerics").at(key).refuse(given != nullptr ? given->find(key) : nullptr, allowed, message);
  };
  if (scene.numerics.integration != Integration::kExplicit)
    refuse("integration", "\"explicit\" with \"solver\": \"mlsrk\"",
           std::string("The solver \"mlsrk\" takes explicit steps only. Take \"integration\" out, or ") +
               kTurnToMpm + ".");
  const std::string off = "null, or left out, with \"solver\": \"mlsrk\"";
  if (scene.numerics.resampling)
    refuse(
        "resampling", off,
        std::string("The solver \"mlsrk\" neither inserts nor merges points. Take \"resampling\" out, or ") +
            kTurnToMpm + ".");
  if (scene.numerics.subgrid_removal)
    refuse("subgrid_removal", off,
           std::string("The solver \"mlsrk\" has no grid. Take \"subgrid_removal\" out, or ") + kTurnToMpm +
               ".");
}

void check_nothing_of(const Value& document, const char* key, bool any, const char* message,
                      const Place& root) {
  if (!any) return;
  root.at(key).refuse(document.find(key), "an empty list, or left out, with \"solver\": \"mlsrk\"",
                      std::string(message) + " Take \"" + key + "\" out, or " + kTurnToMpm + ".");
}

/// Along a periodic axis no point may see two images of another.
void check_periods_of_mlsrk(const Scene& scene, const Place& root) {
  constexpr double kLeast = 2 * tables::kMaxSupportRadius;
  static const std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (int i = 0; i < scene.dimension; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const double extent = scene.domain.box.extent()[i];
    if (!scene.domain.periodic[axis] || extent >= kLeast * scene.spacing * (1 - 1e-9)) continue;
    root.at("domain")
        .at("periodic")
        .at(axis)
        .refuse(Value(true),
                "an extent of at least 8 spacings, " + write_json(Value(kLeast * scene.spacing)) +
                    " m, with \"solver\": \"mlsrk\"",
                "The domain's extent along " + std::string(kAxes[axis]) + " is " + write_json(Value(extent)) +
                    " m, so that points would see each other on both sides. Widen the domain along " +
                    kAxes[axis] + ", or take a smaller \"spacing\".");
  }
}

}  // namespace

void check_solver(const Value& document, const Scene& scene, const Place& root) {
  if (scene.solver == Solver::kMpm) {
    check_foam_only(document, scene, root.at("numerics"));
    check_no_phases_in_mpm(scene, root.at("materials"));
    if (!scene.grips.empty())
      root.at("grips").refuse(document.find("grips"), "an empty list, or left out, with \"solver\": \"mpm\"",
                              "The solver \"mpm\" neither holds nor drives points. Use an adhesive obstacle "
                              "with a \"motion\", or "
                              "set \"solver\" to \"mlsrk\".");
    return;
  }
  if (scene.points_per_cell != 1)
    root.at("points_per_cell")
        .refuse(document.find("points_per_cell"), "1 with \"solver\": \"mlsrk\"",
                "\"spacing\" is the distance of the points there. Take \"points_per_cell\" out, and choose "
                "\"spacing\".");
  check_no_tearing(scene, root.at("materials"));
  check_no_mpm_numerics(document, scene, root);
  check_nothing_of(document, "emitters", !scene.emitters.empty(),
                   "The solver \"mlsrk\" lets nothing in during the run.", root);
  check_nothing_of(document, "probes", !scene.probes.empty(), "The solver \"mlsrk\" takes no probes.", root);
  check_periods_of_mlsrk(scene, root);
}

}  // namespace lather
