#include <cmath>

#include "sim/scene/mesh_library.h"
#include "sim/scene/quality.h"
#include "sim/scene/scene.h"
#include "sim/scene/scene_check.h"
#include "sim/scene/tables.h"

namespace lather {
namespace {

using namespace descriptor;  // the vocabulary of tables

void check_format(const Value& document, const Place& root) {
  const Value* version = document.find("lather");
  const auto* number = version != nullptr ? std::get_if<std::int64_t>(&version->data) : nullptr;
  if (number != nullptr && *number == kSceneFormat) return;
  root.at("lather").refuse(version, "1",
                           version == nullptr ? "\"lather\" is missing: the version of the scene format."
                                              : "This version of the scene format is not known.");
}

void check_sizes(const Value& document, const Place& root) {
  const Value* sizes = document.find("sizes");
  if (sizes == nullptr) return;
  const Place place = root.at("sizes");
  if (sizes->object() == nullptr) {
    place.refuse(*sizes, "an object of objects", "The sizes must be an object.");
    return;
  }
  for (const auto& [name, patch] : *sizes->object()) {
    if (patch.object() == nullptr) place.at(name).refuse(patch, "an object", "A size must be an object.");
  }
}

/// The changes of the size; throws where the scene has no such size.
Value patch_of(const Value& document, std::string_view size) {
  const Value* sizes = document.find("sizes");
  std::vector<std::string> names;
  if (sizes != nullptr && sizes->object() != nullptr) {
    for (const auto& [name, patch] : *sizes->object()) {
      if (name == size) return patch;
      names.push_back(name);
    }
  }
  throw InputError({{"/sizes", write_json(Value(std::string(size))),
                     names.empty() ? "no size: this scene names none" : listed(names),
                     "The scene has no size of that name."}});
}

/// Problems with what a size or nobody else set point into the size.
void point_into_size(std::vector<Problem>& problems, const Value& patch, std::string_view size,
                     const std::vector<Override>& overrides) {
  for (Problem& problem : problems) {
    if (problem.pointer.empty() || at_pointer(patch, problem.pointer) == nullptr) continue;
    bool overridden = false;
    for (const Override& change : overrides) {
      overridden = overridden || problem.pointer.compare(0, change.pointer.size(), change.pointer) == 0;
    }
    if (!overridden) problem.pointer = "/sizes" + pointer_token(size) + problem.pointer;
  }
}

/// The override's JSON; text that is no JSON stands for itself.
Value value_of(const Override& change) {
  try {
    return parse_json(change.json);
  } catch (const InputError&) {
    return Value(change.json);
  }
}

void apply(const std::vector<Override>& overrides, Value& document) {
  for (const Override& change : overrides) {
    if (change.pointer.empty() || change.pointer.compare(0, 6, "/sizes") == 0) {
      throw InputError(
          {{change.pointer, change.json, "a pointer to a field of the scene, e.g. /numerics/time_step",
            "An override cannot replace the scene or its sizes."}});
    }
    set_at_pointer(document, change.pointer, value_of(change));
  }
}

/// The dimension decides how vectors are read, so it is read first; its problems are noted with the other
/// fields.
int dimension_of(const Value& document) {
  const Value* given = document.find("dimension");
  const auto* number = given != nullptr ? std::get_if<std::int64_t>(&given->data) : nullptr;
  return number != nullptr && *number == 2 ? 2 : 3;
}

/// The numerics that the document's own keys are read into: those of its quality.
Numerics numerics_before_reading(const Value& document) {
  const Value* quality = document.find("quality");
  const Value* solver = document.find("solver");
  if (quality == nullptr || quality->text() == nullptr) return {};
  const Solver known = solver != nullptr && solver->text() != nullptr && *solver->text() == "mlsrk"
                           ? Solver::kMlsrk
                           : Solver::kMpm;
  for (const QualityPoint& point : quality_points(known))
    if (*quality->text() == point.name) return numerics_of(known, point.quality);
  return {};
}

void check_budget_alone(const Value& document, const Scene& scene, const Place& root) {
  if (!scene.budget || scene.quality == Quality::kOwn) return;
  root.at("quality").refuse(document.find("quality"), "only where there is no budget",
                            "The budget chooses the quality; take out \"quality\" or \"budget\".");
}

Scene read(const Value& document, const MeshSource& source, std::vector<Problem>& problems) {
  MeshLibrary meshes(source);
  Reading reading;
  reading.meshes = &meshes;
  reading.dimension = dimension_of(document);
  const Place root(reading);
  Scene scene;
  scene.numerics = numerics_before_reading(document);
  if (const Value* given = document.find("numerics")) scene.given_numerics = write_json(*given);
  check_format(document, root);
  check_sizes(document, root);
  std::vector<std::string> known = tables::scene().names();
  for (const FieldInfo& field : tables::document_fields()) known.push_back(field.name);
  refuse_unknown_keys(*document.object(), known, root);
  tables::scene().read_fields(document, scene, root);
  check_budget_alone(document, scene, root);
  check_names(document, scene, root);
  if (reading.problems.empty()) check_whole(document, scene, root);
  problems = std::move(reading.problems);
  scene.meshes = meshes.files();
  return scene;
}

}  // namespace

double density(const Law& law) {
  struct Density {
    double operator()(const HerschelBulkleyParameters& p) const { return p.density; }
    double operator()(const LiquidParameters& p) const { return p.density; }
    double operator()(const NeoHookeanParameters& p) const { return p.elastic.density; }
    double operator()(const DruckerPragerParameters& p) const { return p.elastic.density; }
    double operator()(const SnowParameters& p) const { return p.elastic.density; }
  };
  return std::visit(Density{}, law);
}

std::vector<std::string> Body::material_names() const {
  if (mixture.empty()) return {material};
  std::vector<std::string> names;
  for (const MixturePart& part : mixture) names.push_back(part.material);
  return names;
}

double Scene::point_volume() const {
  return std::pow(spacing, dimension) / points_per_cell;
}

int Scene::last_frame() const {
  return static_cast<int>(std::floor(duration * frame_rate + 1e-9));
}

bool Scene::has_phases() const {
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material& m) { return m.phase.has_value(); });
}

bool Scene::wants_skin() const {
  return look.style == "skin" || !output.skin.empty();
}

Scene parse_scene(std::string_view json, std::string_view size, const std::vector<Override>& overrides,
                  const MeshSource& meshes) {
  Value document = parse_json(json);
  if (document.object() == nullptr) {
    throw InputError(
        {{"", write_json(document).substr(0, 40), "an object", "A scene must be a JSON object."}});
  }
  Value patch;
  if (!size.empty()) {
    patch = patch_of(document, size);
    if (patch.object() != nullptr) merge_patch(document, patch);
  }
  apply(overrides, document);
  std::vector<Problem> problems;
  Scene scene = read(document, meshes, problems);
  if (!problems.empty()) {
    point_into_size(problems, patch, size, overrides);
    throw InputError(std::move(problems));
  }
  return scene;
}

}  // namespace lather
