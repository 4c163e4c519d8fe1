#include <openssl/evp.h>

#include <map>
#include <nlohmann/json.hpp>

#include "sim/plan/plan.h"
#include "sim/scene/quality.h"
#include "sim/shape/mesh_solid.h"

namespace lather {

using Json = nlohmann::ordered_json;

namespace {

std::string base64(const std::string& bytes) {
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');  // libcrypto ends it with a zero
  const int size =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text;
}

/// Empty where the text is no base64.
std::string from_base64(const std::string& text) {
  std::string bytes(text.size() / 4 * 3, '\0');
  const int size =
      EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                      reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  const std::size_t padding = text.size() - std::min(text.size(), text.find_last_not_of('=') + 1);
  bytes.resize(size < 0 || padding > 2 ? 0 : static_cast<std::size_t>(size) - padding);
  return bytes;
}

/// The meshes that a plan carries. Their bytes are held to the SHA-256 in the scene.
MeshSource meshes_of(const nlohmann::json& plan) {
  std::map<std::string, std::string> meshes;
  if (const auto held = plan.find("meshes"); held != plan.end() && held->is_object())
    for (const auto& [file, text] : held->items())
      if (text.is_string()) meshes[file] = from_base64(text.get<std::string>());
  return [meshes = std::move(meshes)](const std::string& file) {
    const auto found = meshes.find(file);
    if (found == meshes.end())
      throw MeshError("The plan does not carry the mesh " + file + ".", "a document made by to_json(Plan)");
    return found->second;
  };
}

template <class AnyJson>
AnyJson parse_plan(std::string_view text) {
  AnyJson json = AnyJson::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("scene") || !json.contains("choices") ||
      !json["choices"].is_object())
    throw InputError({{"", "", "a document made by to_json(Plan)", "This is not a plan."}});
  return json;
}

/// What was chosen for the scene's budget.
std::optional<BudgetChoice> budget_of(const nlohmann::json& choices, Solver solver) {
  const auto held = choices.find("budget");
  if (held == choices.end() || !held->is_object()) return std::nullopt;
  const auto number = [&](const char* key) {
    const auto found = held->find(key);
    return found != held->end() && found->is_number() ? found->get<double>() : 0.0;
  };
  BudgetChoice choice;
  choice.seconds = number("seconds");
  choice.error = number("error");
  const auto name = held->find("quality");
  for (const QualityPoint& point : quality_points(solver))
    if (name != held->end() && *name == point.name) choice.quality = point.quality;
  return choice;
}

Scene scene_of(const nlohmann::json& plan, const std::vector<Override>& overrides) {
  return parse_scene(plan["scene"].dump(), "", overrides, meshes_of(plan));
}

}  // namespace

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
                         {"own_viscosity", m.own_viscosity},
                         {"numerical_viscosity", m.numerical_viscosity},
                         {"step_viscosity", m.step_viscosity}});
  }
  Json meshes = Json::object();
  for (const auto& mesh : plan.scene.meshes) meshes[mesh->file] = base64(mesh->bytes);
  Json json = {{"lather_plan", 1},
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
  if (!plan.quality.empty()) {
    Json keys = Json::array();
    for (const QualityKey& key : plan.quality)
      keys.push_back({{"pointer", key.pointer}, {"value", Json::parse(key.value)}, {"kept", key.kept}});
    json["quality"] = {{"name", quality_point(plan.scene.solver, plan.chosen_quality()).name},
                       {"keys", std::move(keys)}};
  }
  if (plan.choices.budget)
    json["choices"]["budget"] = {
        {"quality", quality_point(plan.scene.solver, plan.choices.budget->quality).name},
        {"seconds", plan.choices.budget->seconds},
        {"error", plan.choices.budget->error}};
  if (!meshes.empty()) json["meshes"] = std::move(meshes);
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Plan read_plan(std::string_view text) {
  const nlohmann::json json = parse_plan<nlohmann::json>(text);
  const auto level = json["choices"].value("kernel_level", nlohmann::json(""));
  Choices choices;
  choices.kernel_level =
      kernel_level_from_string(level.is_string() ? level.get<std::string>() : std::string());
  const Scene scene = scene_of(json, {});
  choices.budget = budget_of(json["choices"], scene.solver);
  return make_plan(scene, choices);
}

Scene read_plan_scene(std::string_view text, const std::vector<Override>& overrides) {
  return scene_of(parse_plan<nlohmann::json>(text), overrides);
}

std::string with_changed_scene(std::string_view text, const std::vector<Override>& overrides) {
  Json json = parse_plan<Json>(text);
  json["scene"] = Json::parse(to_json(read_plan_scene(text, overrides)));
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lather
