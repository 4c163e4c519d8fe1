#include <nlohmann/json.hpp>

#include "sim/plan/plan.h"

namespace lather {

using Json = nlohmann::ordered_json;

std::string to_json(const Plan& plan) {
  Json materials = Json::array();
  for (const PlannedMaterial& m : plan.materials) {
    Json fields = Json::array();
    for (const PlannedField& f : m.fields) fields.push_back({{"name", f.name}, {"bytes", f.bytes}});
    materials.push_back({{"name", m.name},
                         {"points", m.points},
                         {"points_emitted", m.points_emitted},
                         {"bytes_per_point", m.bytes_per_point},
                         {"fields", fields},
                         {"wave_speed", m.wave_speed},
                         {"numerical_viscosity", m.numerical_viscosity}});
  }
  const Json json = {{"lather_plan", 1},
                     {"choices", {{"kernel_level", to_string(plan.choices.kernel_level)}}},
                     {"points", plan.points},
                     {"points_emitted", plan.points_emitted},
                     {"frames", plan.frames},
                     {"steps", plan.steps},
                     {"time_step", plan.time_step},
                     {"step_bound", plan.step_bound},
                     {"memory_bytes", plan.memory_bytes},
                     {"stages", plan.stages},
                     {"scalars", plan.scalars},
                     {"materials", materials},
                     {"warnings", plan.warnings},
                     {"scene", Json::parse(to_json(plan.scene))}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Plan read_plan(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("scene") || !json.contains("choices") ||
      !json["choices"].is_object())
    throw InputError({{"", "", "a document made by to_json(Plan)", "This is not a plan."}});
  const auto level = json["choices"].value("kernel_level", nlohmann::json(""));
  Choices choices;
  choices.kernel_level =
      kernel_level_from_string(level.is_string() ? level.get<std::string>() : std::string());
  return make_plan(parse_scene(json["scene"].dump()), choices);
}

}  // namespace lather
