#include "sim/study/soak/random_scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/math/counter_rng.h"
#include "sim/plan/plan.h"
#include "sim/scene/sha256.h"
#include "sim/scene/value.h"
#include "sim/study/soak/random_document.h"

namespace lather::study {
namespace {

constexpr std::uint64_t kMostPoints = 4000;
constexpr int kMostChanges = 100;    // of one document
constexpr int kMostDocuments = 100;  // of one scene

/// Meshes are read often, and are all of the same file.
void make_meshes_coarse(Value& schema) {
  for (Value& shape : *schema.find("$defs")->find("shape")->find("oneOf")->array()) {
    Value* properties = shape.find("properties");
    Value* resolution = properties->find("resolution");
    if (resolution == nullptr) continue;
    *resolution = Object{{"const", std::int64_t{16}}};
    *properties->find("sha256") = Object{{"const", sha256_hex(random_scene_mesh())}};
    shape.find("required")->array()->emplace_back("resolution");
  }
}

/// The schema of scenes, but with bodies, for a scene without any needs emitters, and with a solver, so that
/// either is as frequent.
Value schema_to_draw_from() {
  Value schema = parse_json(scene_schema());
  for (const char* const key : {"bodies", "solver"}) schema.find("required")->array()->emplace_back(key);
  make_meshes_coarse(schema);
  return schema;
}

/// Draws that belong to a scene and not to any field of its document.
double chance(std::uint64_t seed, std::uint64_t index, std::uint64_t which) {
  return random_unit(~seed, index, which);
}

Surroundings random_surroundings(std::uint64_t seed, std::uint64_t index) {
  const auto draw = [&](std::uint64_t which) { return chance(seed, index, which); };
  Surroundings s;
  s.dimension = draw(0) < 0.5 ? 2 : 3;
  s.spacing = std::pow(10.0, -4 + 5 * draw(1));
  s.duration = std::pow(10.0, -3 + 4 * draw(2));
  for (int axis = 0; axis < 3; ++axis) {
    s.size[axis] = s.spacing * (4 + std::floor(11 * draw(3 + static_cast<std::uint64_t>(axis))));
    s.corner[axis] = s.size[axis] * std::floor(3 * draw(6 + static_cast<std::uint64_t>(axis)) - 2);
  }
  return s;
}

Array vector_of(const Vec3& v, int dimension) {
  Array numbers;
  for (int axis = 0; axis < dimension; ++axis) numbers.emplace_back(v[axis]);
  return numbers;
}

void set_duration(Value& document, double duration, double frames) {
  set_at_pointer(document, "/duration", duration);
  set_at_pointer(document, "/frame_rate", frames / duration);
}

/// The drawn document in its surroundings, and of a handful of frames.
Value in_surroundings(Value document, const Surroundings& s, double frames) {
  for (const char* const key : {"/sizes", "/points_per_cell"}) set_at_pointer(document, key, nullptr);
  set_at_pointer(document, "/dimension", std::int64_t{s.dimension});
  set_at_pointer(document, "/domain/min", vector_of(s.corner, s.dimension));
  set_at_pointer(document, "/domain/max", vector_of(s.corner + s.size, s.dimension));
  set_at_pointer(document, "/spacing", s.spacing);
  set_duration(document, s.duration, frames);
  return document;
}

/// Takes the value at `pointer` out of the document, or the nearest one around it that is there and not the
/// whole.
bool take_out(Value& document, std::string pointer) {
  while (!pointer.empty()) {
    const std::size_t slash = pointer.rfind('/');
    const std::string last = pointer.substr(slash + 1);
    const bool there = at_pointer(document, pointer) != nullptr;
    const std::string around = pointer.substr(0, slash);
    if (there) {
      const Value* owner = at_pointer(document, around);
      if (owner->array() == nullptr) {
        set_at_pointer(document, pointer, nullptr);
        return true;
      }
      Array shorter = *owner->array();
      shorter.erase(shorter.begin() + std::stol(last));
      set_at_pointer(document, around, std::move(shorter));
      return true;
    }
    pointer = around;
  }
  return false;
}

std::string mesh_bytes(const std::string&) {
  return random_scene_mesh();
}

}  // namespace

const char* random_scene_mesh() {
  return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
}

RandomScene random_scene(std::uint64_t seed, std::uint64_t index, std::uint64_t most_steps) {
  static const Value kSchema = schema_to_draw_from();
  RandomScene made;
  for (std::uint64_t document = 0; document < kMostDocuments; ++document) {
    const std::uint64_t which = index * kMostDocuments + document;
    const Surroundings s = random_surroundings(seed, which);
    const double frames = std::floor(1 + 4 * chance(seed, which, 9));
    Value drawn = in_surroundings(random_document(kSchema, s, seed, which), s, frames);
    for (int change = 0; change < kMostChanges; ++change) {
      made.document = write_json(drawn, 2);
      try {
        made.scene = parse_scene(made.document, "", {}, mesh_bytes);
        const Plan plan = make_plan(made.scene);
        if (plan.points > kMostPoints) break;
        if (plan.steps <= most_steps) return made;
        // A little less, so that steps that end at frames make it no more.
        set_duration(drawn, 0.9 * static_cast<double>(most_steps) * plan.time_step, frames);
      } catch (const InputError& error) {
        ++made.refusals;
        if (!take_out(drawn, error.problems().front().pointer)) break;
      }
    }
  }
  throw std::logic_error("no scene was taken of " + std::to_string(kMostDocuments) + " documents");
}

}  // namespace lather::study
