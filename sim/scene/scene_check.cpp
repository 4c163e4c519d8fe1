#include "sim/scene/scene_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/scene/solver_check.h"

namespace lather {
namespace {

using descriptor::Place;

constexpr double kMinCells = 4;
constexpr double kMaxCells = 32'000;
constexpr double kMaxFrames = 100'000;
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

std::string text_of(double x) {
  return write_json(Value(x));
}

template <class T>
void check_unique(const std::vector<T>& list, const Place& place) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto same = [&](const T& other) { return other.name == list[i].name; };
    const auto end = list.begin() + static_cast<std::ptrdiff_t>(i);
    if (list[i].name.empty() || std::find_if(list.begin(), end, same) == end) continue;
    place.at(i).at("name").refuse(Value(list[i].name), "a name of its own",
                                  "The name \"" + list[i].name + "\" is given to an earlier one already.");
  }
}

/// Notes a name at `place` that is none of `names`, which are those of the scene's things of one kind,
/// "obstacle".
void check_known(const std::string& wanted, const std::vector<std::string>& names, const std::string& kind,
                 const Place& place) {
  if (wanted.empty() || std::find(names.begin(), names.end(), wanted) != names.end()) return;
  const std::string near = descriptor::nearest_name(wanted, names);
  place.refuse(Value(wanted),
               names.empty() ? "none: the scene has no " + kind + " at all" : descriptor::listed(names),
               "The scene has no " + kind + " of that name." +
                   (near.empty() ? "" : " Did you mean \"" + near + "\"?"));
}

template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const T& entry : list) names.push_back(entry.name);
  return names;
}

/// Every body and emitter is of materials that the scene has.
void check_materials_known(const Scene& scene, const Place& root) {
  const std::vector<std::string> names = names_of(scene.materials);
  if (std::find(names.begin(), names.end(), "") != names.end()) return;  // noted already
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Place place = root.at("bodies").at(i);
    check_known(body.material, names, "material", place.at("material"));
    for (std::size_t k = 0; k < body.mixture.size(); ++k)
      check_known(body.mixture[k].material, names, "material", place.at("mixture").at(k).at("material"));
  }
  for (std::size_t i = 0; i < scene.emitters.size(); ++i)
    check_known(scene.emitters[i].material, names, "material", root.at("emitters").at(i).at("material"));
}

void check_probed_obstacles_known(const Scene& scene, const Place& list) {
  const std::vector<std::string> names = names_of(scene.obstacles);
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const auto* force = std::get_if<ForceProbe>(&scene.probes[i].kind);
    const auto* point = std::get_if<PointProbe>(&scene.probes[i].kind);
    const std::string wanted = force != nullptr ? force->obstacle : point != nullptr ? point->obstacle : "";
    check_known(wanted, names, "obstacle", list.at(i).at("obstacle"));
  }
}

/// Samples of all probes that a run may take: they stay in memory, in checkpoints and in the report.
constexpr double kMaxSamples = 1e6;

void check_samples(const Scene& scene, const Place& root) {
  double samples = 0;
  for (const Probe& p : scene.probes)
    samples += p.interval > 0 ? scene.duration / p.interval : scene.duration * scene.frame_rate;
  if (samples <= kMaxSamples) return;
  root.at("probes").refuse(
      nullptr, "1000000 samples in all",
      "The probes would take " + text_of(std::round(samples)) + " samples; raise their \"interval\".");
}

/// A semi-implicit step holds nodes at obstacles while it solves; what that takes is not told obstacle by
/// obstacle.
void check_probes_of_forces(const Scene& scene, const Place& root) {
  if (scene.numerics.integration != Integration::kSemiImplicit) return;
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const auto& kind = scene.probes[i].kind;
    if (!std::holds_alternative<ForceProbe>(kind) && !std::holds_alternative<WallProbe>(kind)) continue;
    root.at("probes").at(i).at("type").refuse(
        Value(std::holds_alternative<ForceProbe>(kind) ? "force" : "walls"), "\"point\" or \"plane\"",
        "Forces are measured with \"integration\": \"explicit\" only.");
  }
}

/// From 4 to 32000 cells along every axis. Notes the first axis that has fewer or more, with the range that
/// fits all.
bool check_cells(const Value& document, const Scene& scene, const Place& root) {
  const Vec3 extent = scene.domain.box.extent();
  const double least = extent.head(scene.dimension).maxCoeff() / kMaxCells;
  const double most = extent.head(scene.dimension).minCoeff() / kMinCells;
  for (int i = 0; i < scene.dimension; ++i) {
    const double cells = extent[i] / scene.spacing;
    if (cells >= kMinCells * (1 - 1e-9) && cells <= kMaxCells * (1 + 1e-9)) continue;
    const std::string range = least <= most
                                  ? "from " + text_of(least) + " to " + text_of(most) + " m"
                                  : "none: the domain is more than 8000 times as long as it is wide";
    return root.at("spacing").refuse(document.find("spacing"), range,
                                     "The domain has " + text_of(std::round(cells * 10) / 10) +
                                         " cells along " + kAxes[static_cast<std::size_t>(i)] +
                                         "; it must have from 4 to 32000.");
  }
  return true;
}

void check_periods(const Scene& scene, const Place& root) {
  for (int i = 0; i < scene.dimension; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const double extent = scene.domain.box.extent()[i];
    const double blocks = extent / scene.spacing / 4;
    if (!scene.domain.periodic[axis] || std::abs(blocks - std::round(blocks)) <= 1e-9 * blocks) continue;
    const double fits = 4 * scene.spacing * std::max(1.0, std::round(blocks));
    root.at("domain")
        .at("periodic")
        .at(axis)
        .refuse(Value(true), "an extent that is a multiple of 4 spacings, e.g. " + text_of(fits) + " m",
                "The domain's extent along " + std::string(kAxes[axis]) + " is " + text_of(extent) +
                    " m, which a periodic grid of this spacing does not fit.");
  }
}

void check_points_per_cell(const Value& document, Scene& scene, const Place& root) {
  static const std::array<int, 4> kPlane = {1, 4, 9, 16};
  static const std::array<int, 4> kSpace = {1, 8, 27, 64};
  const std::array<int, 4>& allowed = scene.dimension == 2 ? kPlane : kSpace;
  if (document.find("points_per_cell") == nullptr)
    scene.points_per_cell = scene.solver == Solver::kMlsrk ? 1 : allowed[1];
  if (std::find(allowed.begin(), allowed.end(), scene.points_per_cell) != allowed.end()) return;
  root.at("points_per_cell")
      .refuse(document.find("points_per_cell"), scene.dimension == 2 ? "1, 4, 9 or 16" : "1, 8, 27 or 64",
              scene.dimension == 2 ? "In 2D a cell holds n^2 points." : "In 3D a cell holds n^3 points.");
}

void check_frames(const Value& document, const Scene& scene, const Place& root) {
  const double frames = scene.duration * scene.frame_rate;
  if (frames <= kMaxFrames) return;
  root.at("duration")
      .refuse(document.find("duration"),
              "at most " + text_of(kMaxFrames / scene.frame_rate) + " s at this frame_rate",
              "The scene would have more than 100000 frames.");
}

/// Nothing moves out of the plane of a 2D scene.
void check_plane(const Value& document, const Scene& scene, const Place& root) {
  const auto refuse = [](const Value* value, const Place& place, const std::string& message) {
    place.refuse(value, "0 across the plane", message);
  };
  if (scene.gravity.z() != 0) refuse(document.find("gravity"), root.at("gravity"), "A 2D scene has no z.");
  if (scene.domain.periodic[2]) {
    refuse(nullptr, root.at("domain").at("periodic").at(2), "A 2D scene cannot be periodic along z.");
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Value& given = (*document.find("bodies")->array())[i];
    const Place place = root.at("bodies").at(i);
    if (body.velocity.z() != 0)
      refuse(given.find("velocity"), place.at("velocity"), "A 2D body cannot leave the plane.");
    if (body.spin_deg.x() != 0 || body.spin_deg.y() != 0) {
      refuse(given.find("spin_deg"), place.at("spin_deg"), "A 2D body can spin about z only.");
    }
    if (!body.velocity_gradient.row(2).isZero(0) || !body.velocity_gradient.col(2).isZero(0)) {
      refuse(given.find("velocity_gradient"), place.at("velocity_gradient"), "A 2D flow has no z.");
    }
  }
}

/// Does a motion keep the plane of a 2D scene in itself?
struct StaysInPlane {
  bool operator()(const AtRest&) const { return true; }
  bool operator()(const LinearMotion& m) const { return m.velocity.z() == 0; }
  bool operator()(const Oscillation& m) const { return m.amplitude == 0 || m.direction.z() == 0; }
  bool operator()(const Rotation& m) const { return m.axis.x() == 0 && m.axis.y() == 0; }
  bool operator()(const Keyframes& m) const {
    return std::all_of(m.keys.begin(), m.keys.end(), [](const Keyframe& k) {
      return k.translate.z() == 0 && k.rotate_deg.x() == 0 && k.rotate_deg.y() == 0;
    });
  }
};

void check_grips_in_plane(const Value& document, const Scene& scene, const Place& root) {
  for (std::size_t i = 0; i < scene.grips.size(); ++i) {
    if (std::visit(StaysInPlane{}, scene.grips[i].motion)) continue;
    const Value& given = (*document.find("grips")->array())[i];
    root.at("grips").at(i).at("motion").refuse(
        given.find("motion"), "shifts along x and y, turns about z",
        "The points of a 2D scene cannot leave the plane; an axis of rotation is [0, 0, 1] there.");
  }
}

/// A surface needs space around it.
void check_skin(const Value& document, const Scene& scene, const Place& root) {
  if (scene.dimension == 3 || !scene.wants_skin()) return;
  const bool drawn = scene.look.style == "skin";
  const Value* const part = document.find(drawn ? "look" : "output");
  const char* const key = drawn ? "style" : "skin";
  root.at(drawn ? "look" : "output")
      .at(key)
      .refuse(part != nullptr ? part->find(key) : nullptr, drawn ? "\"points\" in 2D" : "no format in 2D",
              "The points of a 2D scene lie in a plane and have no skin.");
}

/// What comes in through an emitter of a 2D scene stays in its plane.
void check_emitters_in_plane(const Value& document, const Scene& scene, const Place& root) {
  for (std::size_t i = 0; i < scene.emitters.size(); ++i) {
    const Emitter& e = scene.emitters[i];
    const Value& given = (*document.find("emitters")->array())[i];
    const Place place = root.at("emitters").at(i);
    if (e.velocity.z() != 0)
      place.at("velocity").refuse(given.find("velocity"), "0 across the plane", "A 2D scene has no z.");
    if (e.spin_deg.x() != 0 || e.spin_deg.y() != 0)
      place.at("spin_deg")
          .refuse(given.find("spin_deg"), "0 across the plane", "A 2D body can spin about z only.");
  }
}

void check_any_material_there(const Value& document, const Scene& scene, const Place& root) {
  if (!scene.bodies.empty() || !scene.emitters.empty()) return;
  const Value* given = document.find("bodies");
  root.at("bodies").refuse(given, "a list of 1 to 1000 bodies; none only where there are emitters",
                           given == nullptr ? "\"bodies\" is missing, and there are no emitters either."
                                            : "The scene has neither bodies nor emitters.");
}

}  // namespace

void check_names(const Value& document, const Scene& scene, const Place& root) {
  check_unique(scene.materials, root.at("materials"));
  check_unique(scene.bodies, root.at("bodies"));
  check_unique(scene.emitters, root.at("emitters"));
  check_unique(scene.obstacles, root.at("obstacles"));
  check_unique(scene.grips, root.at("grips"));
  check_unique(scene.probes, root.at("probes"));
  check_probed_obstacles_known(scene, root.at("probes"));
  for (std::size_t i = 0; i < scene.grips.size(); ++i)
    check_known(scene.grips[i].body, names_of(scene.bodies), "body", root.at("grips").at(i).at("body"));
  if (document.find("materials") != nullptr) check_materials_known(scene, root);
}

void check_whole(const Value& document, Scene& scene, const Place& root) {
  check_points_per_cell(document, scene, root);
  check_solver(document, scene, root);
  if (check_cells(document, scene, root)) check_periods(scene, root);
  check_frames(document, scene, root);
  check_samples(scene, root);
  check_probes_of_forces(scene, root);
  check_any_material_there(document, scene, root);
  if (scene.dimension == 2) check_plane(document, scene, root);
  check_skin(document, scene, root);
  if (scene.dimension == 2) check_emitters_in_plane(document, scene, root);
  if (scene.dimension == 2) check_grips_in_plane(document, scene, root);
  const std::size_t colors = scene.look.material_colors.size();
  if (colors == 0 || colors >= scene.materials.size()) return;
  root.at("look")
      .at("material_colors")
      .refuse(document.find("look")->find("material_colors"),
              "none, or " + std::to_string(scene.materials.size()) + " colours",
              "There are too few colours.");
}

}  // namespace lather
