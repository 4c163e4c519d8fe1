#include "sim/study/tradeoff/knobs.h"

#include <algorithm>
#include <cmath>

#include "sim/error.h"
#include "sim/scene/descriptor.h"
#include "sim/shape/mesh_solid.h"

namespace lather::study {
namespace {

constexpr Solver kMpm = Solver::kMpm;
constexpr Solver kMlsrk = Solver::kMlsrk;

/// The pointers that `pointer` means: "*" stands for every index of the array that it is in.
std::vector<std::string> expanded(const Value& document, const std::string& pointer) {
  const std::size_t star = pointer.find("/*");
  if (star == std::string::npos) return {pointer};
  std::vector<std::string> out;
  const Value* list = at_pointer(document, pointer.substr(0, star));
  if (list == nullptr || list->array() == nullptr) return out;
  for (std::size_t i = 0; i < list->array()->size(); ++i) {
    const std::string one = pointer.substr(0, star) + "/" + std::to_string(i) + pointer.substr(star + 2);
    const std::vector<std::string> all = expanded(document, one);
    out.insert(out.end(), all.begin(), all.end());
  }
  return out;
}

std::optional<double> number_of(const Value* value) {
  if (value == nullptr) return std::nullopt;
  if (const auto* whole = std::get_if<std::int64_t>(&value->data)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value->data)) return *real;
  return std::nullopt;
}

/// What changes in the document of a scene when the knob is turned.
void add_overrides(const Setting& setting, const Value& document, int dimension,
                   std::vector<Override>& overrides) {
  for (const std::string& pointer : expanded(document, setting.pointer)) {
    Value value = setting.value;
    if (setting.turn == Turn::kPerAxis) {
      value = static_cast<std::int64_t>(std::llround(std::pow(factor_of(setting), dimension)));
    } else if (setting.turn == Turn::kScale) {
      const std::optional<double> now = number_of(at_pointer(document, pointer));
      if (!now) continue;
      value = *now * factor_of(setting);
    }
    overrides.push_back({pointer, write_json(value)});
  }
}

/// The meshes of a scene, by the names that it has for them.
MeshSource meshes_of(const Scene& scene) {
  return [&scene](const std::string& file) {
    for (const auto& mesh : scene.meshes)
      if (mesh->file == file) return mesh->bytes;
    throw MeshError("The scene does not carry the mesh " + file + ".", "a mesh that was read with it");
  };
}

}  // namespace

// A new knob is a line here.
const std::vector<Knob>& knobs() {
  using Turn::kPerAxis, Turn::kScale, Turn::kSet;
  static const std::vector<Knob> all = {
      {"spacing", kSpacingPointer, kScale, {1.5, 0.75}, {}},
      {"points-per-cell", kPointsPointer, kPerAxis, {1, 2, 3}, kMpm},
      {"kernel", "/numerics/kernel", kSet, {"quadratic", "cubic"}, kMpm},
      {"transfer", "/numerics/transfer", kSet, {"flip", "apic"}, kMpm},
      {"flip-blend", "/numerics/flip_blend", kSet, {0.0, 0.9, 0.99, 1.0}, kMpm},
      {"precision", "/numerics/precision", kSet, {"float", "double"}, {}},
      {"safety-factor", "/numerics/safety_factor", kSet, {0.1, 0.2, 0.4, 0.8}, {}},
      {"integration", "/numerics/integration", kSet, {"explicit", "semi-implicit"}, kMpm},
      {"implicit-step-factor", "/numerics/implicit_step_factor", kSet, {5.0, 20.0}, kMpm},
      {"bulk-modulus", "/materials/*/bulk_modulus", kScale, {0.1, 0.3, 3.0}, {}},
      {"resampling", "/numerics/resampling", kSet, {nullptr, Object{}}, kMpm},
      {"resampling-interval", "/numerics/resampling/interval", kScale, {0.2, 5.0}, kMpm},
      {"basis", "/numerics/mlsrk/basis", kSet, {"constant", "linear", "quadratic"}, kMlsrk},
      {"kernel-shape", "/numerics/mlsrk/kernel_shape", kSet, {"tensor", "radial"}, kMlsrk},
      {"support-radius", "/numerics/mlsrk/support_radius", kSet, {2.0, 2.5, 3.0, 3.5}, kMlsrk},
      {"regularization", "/numerics/mlsrk/regularization", kSet, {0.0, 1e-4, 1e-3, 1e-2}, kMlsrk},
      {"velocity-blend", "/numerics/mlsrk/velocity_blend", kSet, {0.8, 0.95, 1.0}, kMlsrk},
      {"inertial-mass", "/numerics/mlsrk/inertial_mass", kSet, {"lumped", "own"}, kMlsrk},
      {"volume-correction", "/numerics/mlsrk/volume_correction", kSet, {true, false}, kMlsrk},
      {"frame-rate", "/frame_rate", kScale, {0.5, 4.0}, {}, false},
      {"image-samples", "/output/supersampling", kSet, {1, 2, 3}, {}, false},
      {"style", "/look/style", kSet, {"points", "skin"}, {}, false}};
  return all;
}

std::vector<Knob> quality_knobs(Solver solver) {
  if (solver == kMpm)
    return {read_knob("kernel=quadratic,cubic"), read_knob("transfer=flip,apic"),
            read_knob("precision=float,double"), read_knob("safety-factor=0.1,0.2,0.3,0.4,0.65")};
  return {read_knob("kernel-shape=tensor,radial"), read_knob("support-radius=2.0,2.5,3.0"),
          read_knob("precision=float,double"), read_knob("safety-factor=0.1,0.2,0.3,0.4,0.6")};
}

const Knob& knob_named(const std::string& name) {
  std::vector<std::string> names;
  for (const Knob& knob : knobs()) {
    if (knob.name == name) return knob;
    names.push_back(knob.name);
  }
  const std::string near = descriptor::nearest_name(name, names);
  throw InputError(
      {{"", name, descriptor::listed(names),
        "There is no knob of that name." + (near.empty() ? "" : " Did you mean \"" + near + "\"?")}});
}

std::string to_text(const Settings& settings) {
  std::string text;
  for (const Setting& s : settings) {
    const std::string* word = s.value.text();
    text += (text.empty() ? "" : ", ") + s.knob + (s.turn == Turn::kScale ? " x " : " = ") +
            (word ? *word : write_json(s.value));
  }
  return text.empty() ? "as it is" : text;
}

Object to_json(const Settings& settings) {
  Object out;
  for (const Setting& s : settings) out.emplace_back(s.knob, s.value);
  return out;
}

double factor_of(const Setting& setting) {
  const std::optional<double> factor = number_of(&setting.value);
  if (!factor || !(*factor > 0))
    throw InputError({{setting.pointer, write_json(setting.value), "a number above 0",
                       "The values of the knob \"" + setting.knob +
                           "\" multiply what the scene has there, or are points along an axis."}});
  return *factor;
}

const Setting* setting_at(const Settings& settings, const std::string& pointer) {
  const auto found =
      std::find_if(settings.begin(), settings.end(), [&](const Setting& s) { return s.pointer == pointer; });
  return found == settings.end() ? nullptr : &*found;
}

bool turns(const Knob& knob, const Scene& scene) {
  if (knob.solver && *knob.solver != scene.solver) return false;
  if (knob.name == "flip-blend" && scene.numerics.transfer != Transfer::kFlip) return false;
  if (knob.name == "implicit-step-factor" && scene.numerics.integration != Integration::kSemiImplicit)
    return false;
  if (knob.turn != Turn::kScale) return true;
  const Value document = parse_json(to_json(scene));
  const std::vector<std::string> pointers = expanded(document, knob.pointer);
  return std::any_of(pointers.begin(), pointers.end(),
                     [&](const std::string& p) { return number_of(at_pointer(document, p)).has_value(); });
}

Scene with_settings(const Scene& scene, const Settings& settings) {
  const std::string text = to_json(scene);
  const Value document = parse_json(text);
  std::vector<Override> overrides;
  for (const Setting& s : settings) add_overrides(s, document, scene.dimension, overrides);
  return parse_scene(text, "", overrides, meshes_of(scene));
}

Knob read_knob(const std::string& text) {
  const std::size_t equals = text.find('=');
  Knob knob = knob_named(text.substr(0, equals));
  if (equals == std::string::npos) return knob;
  knob.values.clear();
  for (std::size_t at = equals; at != std::string::npos;) {
    const std::size_t end = text.find(',', at + 1);
    const std::string word = text.substr(at + 1, end == std::string::npos ? end : end - at - 1);
    try {
      knob.values.push_back(parse_json(word));
    } catch (const InputError&) {
      knob.values.emplace_back(word);
    }
    at = end;
  }
  return knob;
}

std::vector<Settings> one_at_a_time(const std::vector<Knob>& of) {
  std::vector<Settings> all = {{}};
  for (const Knob& knob : of)
    for (const Value& value : knob.values) all.push_back({{knob.name, knob.pointer, knob.turn, value}});
  return all;
}

std::vector<Settings> product(const std::vector<Knob>& of) {
  std::vector<Settings> all = {{}};
  for (const Knob& knob : of) {
    std::vector<Settings> next;
    for (const Settings& before : all)
      for (const Value& value : knob.values) {
        next.push_back(before);
        next.back().push_back({knob.name, knob.pointer, knob.turn, value});
      }
    all = std::move(next);
  }
  return all;
}

}  // namespace lather::study
