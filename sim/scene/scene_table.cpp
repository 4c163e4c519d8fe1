#include <algorithm>

#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

constexpr std::size_t kMaxMaterials = 255;
constexpr std::size_t kMaxBodies = 1000;
constexpr std::size_t kMaxEmitters = 1000;
constexpr std::size_t kMaxObstacles = 1000;
constexpr std::size_t kMaxGrips = 1000;
constexpr std::size_t kMaxProbes = 100;
constexpr double kMaxGradient = 1e6;  // 1/s

Codec<Vec3> point() {
  return vector("m", from_to(-kMaxLength, kMaxLength));
}
Codec<Vec3> velocity() {
  return vector("m/s", from_to(-kMaxSpeed, kMaxSpeed));
}

void check_domain(const Value& value, Domain& d, const Place& place) {
  const int axes = place.dimension();
  if (axes == 2) d.box.min.z() = d.box.max.z() = 0;
  for (int i = 0; i < axes; ++i) {
    if (d.box.max[i] > d.box.min[i]) continue;
    place.at("max")
        .at(static_cast<std::size_t>(i))
        .refuse((*value.find("max")->array())[static_cast<std::size_t>(i)],
                "above min, " + write_json(d.box.min[i]) + " m", "The domain is empty along this axis.");
  }
}

/// A field that is written only where `there` says so of what it belongs to.
template <class T, class There>
Field<T> written_where(const There& there, Field<T> field) {
  field.write = [there, write = field.write](const T& source) {
    return there(source) ? write(source) : std::nullopt;
  };
  return field;
}

void check_body(const Value& value, Body& /*body*/, const Place& place) {
  const Value* material = value.find("material");
  const Value* mixture = value.find("mixture");
  if (mixture != nullptr && material != nullptr)
    place.at("material")
        .refuse(material, "only where there is no mixture",
                "A body is of one material or a mixture of several; take out \"material\" or \"mixture\".");
  if (mixture == nullptr && material == nullptr)
    place.at("material")
        .refuse(nullptr, "text of 1 to 64 bytes",
                "\"material\" is missing: the name of a material; or give a \"mixture\".");
}

void check_obstacle(const Value& value, Obstacle& o, const Place& place) {
  if (!o.adhesive || o.friction == 0) return;
  place.at("friction")
      .refuse(value.find("friction"), "only where adhesive is false",
              "An adhesive obstacle holds what touches it; take out \"friction\" or \"adhesive\".");
}

/// What the other solver alone reads is not written: it does not tell scenes apart.
Field<Scene> numerics_field() {
  Field<Scene> out = optional<Scene>("numerics", &Scene::numerics, object_of(numerics()),
                                     "how it is computed", "see numerics");
  out.write = [write = out.write](const Scene& s) {
    std::optional<Value> value = write(s);
    if (s.solver == Solver::kMlsrk) return value;
    Object& keys = *value->object();
    keys.erase(
        std::remove_if(keys.begin(), keys.end(), [](const auto& entry) { return entry.first == "mlsrk"; }),
        keys.end());
    return value;
  };
  return out;
}

}  // namespace

const Table<Domain>& domain() {
  static const Table<Domain> table(
      "domain", "The box that the simulation takes place in.",
      {required<Domain>(
           "min", [](auto& d) -> auto& { return d.box.min; }, point(), "corner with the least coordinates"),
       required<Domain>(
           "max", [](auto& d) -> auto& { return d.box.max; }, point(), "corner opposite"),
       optional<Domain>("periodic", &Domain::periodic, three_flags(),
                        "axes along which the domain repeats; its extent there is a multiple of 4 spacings"),
       optional<Domain>(
           "boundary", &Domain::boundary,
           enumeration<Boundary>(
               {{"slip", Boundary::kSlip}, {"stick", Boundary::kStick}, {"open", Boundary::kOpen}}),
           "faces that are not periodic: points glide, stick, or leave and are removed")},
      {}, check_domain);
  return table;
}

const Table<MixturePart>& mixture_part() {
  static const Table<MixturePart> table(
      "mixture", "One of the materials that the points of a body are of.",
      {required<MixturePart>("material", &MixturePart::material, text(1, 64), "the name of a material"),
       optional<MixturePart>("share", &MixturePart::share, number("1", above_to(0, 1e6)),
                             "chance of a point to be of it, over the sum of all shares")});
  return table;
}

const Table<Body>& body() {
  static const Table<Body> table(
      "body", "Material in the form of a shape.",
      {required<Body>("name", &Body::name, text(1, 64), "for messages and reports"),
       written_where([](const Body& b) { return b.mixture.empty(); },
                     optional<Body>("material", &Body::material, text(1, 64), "the name of a material",
                                    "required, or a mixture")),
       written_where(
           [](const Body& b) { return !b.mixture.empty(); },
           optional<Body>("mixture", &Body::mixture,
                          list_of(object_of(mixture_part()), 1, kMaxMaterials, "materials"),
                          "in place of a material: every point is of one of these, at random", "none")),
       required<Body>("shape", &Body::shape, shape_codec(), "its form at t = 0"),
       optional<Body>("velocity", &Body::velocity, velocity(), "at t = 0"),
       optional<Body>("spin_deg", &Body::spin_deg, vector("degrees/s", from_to(-1e8, 1e8)),
                      "angular velocity about the centre of mass at t = 0"),
       optional<Body>("velocity_gradient", &Body::velocity_gradient,
                      matrix("1/s", from_to(-kMaxGradient, kMaxGradient)),
                      "adds gradient * x (x from the world's origin) to the velocity at t = 0")},
      {}, check_body);
  return table;
}

const Table<Obstacle>& obstacle() {
  static const Table<Obstacle> table(
      "obstacle", "A rigid thing that material cannot enter.",
      {required<Obstacle>("name", &Obstacle::name, text(1, 64), "for messages and reports"),
       required<Obstacle>("shape", &Obstacle::shape, shape_codec(), "its form and place"),
       optional<Obstacle>("adhesive", &Obstacle::adhesive, flag(), "material that touches it moves with it"),
       optional<Obstacle>("friction", &Obstacle::friction, number("1", from_to(0, 1e3)),
                          "Coulomb coefficient"),
       optional<Obstacle>("motion", &Obstacle::motion, motion_codec(), "how it moves",
                          "{\"type\": \"rest\"}"),
       optional<Obstacle>("visible", &Obstacle::visible, flag(), "draw it")},
      {}, check_obstacle);
  return table;
}

const Table<Scene>& scene() {
  static const Table<Scene> table(
      "scene",
      "SI units, y up, angles in degrees. A 2D scene lies in the x-y plane; shapes are cut at z = 0.",
      {optional<Scene>("name", &Scene::name, text(0, 200), "for people"),
       optional<Scene>("solver", &Scene::solver,
                       enumeration<Solver>({{"mpm", Solver::kMpm}, {"mlsrk", Solver::kMlsrk}}),
                       "the method: points over a grid, or points alone"),
       optional<Scene>("dimension", &Scene::dimension, integer(2, 3), "2 (plane strain) or 3"),
       required<Scene>("domain", &Scene::domain, object_of(domain()),
                       "the box that the simulation takes place in"),
       optional<Scene>("gravity", &Scene::gravity, vector("m/s^2", from_to(-1e6, 1e6)),
                       "acceleration of all material"),
       required<Scene>("duration", &Scene::duration, number("s", above_to(0, 1e6)), "simulated time"),
       optional<Scene>("frame_rate", &Scene::frame_rate, number("1/s", above_to(0, 1e30)),
                       "pictures per simulated second"),
       required<Scene>("spacing", &Scene::spacing, number("m", from_to(1e-6, 1e3)),
                       "cell width of the grid; with the solver \"mlsrk\", distance of the points"),
       optional<Scene>(
           "points_per_cell", &Scene::points_per_cell, integer(1, 64),
           "material points in a full cell: n^3 in 3D, n^2 in 2D, n from 1 to 4; 1 with the solver "
           "\"mlsrk\"",
           "8 in 3D, 4 in 2D, 1 with mlsrk"),
       required<Scene>("materials", &Scene::materials,
                       list_of(material_codec(), 1, kMaxMaterials, "materials"), "what bodies are made of"),
       optional<Scene>("bodies", &Scene::bodies, list_of(object_of(body()), 0, kMaxBodies, "bodies"),
                       "material at t = 0; needed where there are no emitters"),
       optional<Scene>("emitters", &Scene::emitters,
                       list_of(object_of(emitter()), 0, kMaxEmitters, "emitters"),
                       "material that comes in later"),
       optional<Scene>("obstacles", &Scene::obstacles,
                       list_of(object_of(obstacle()), 0, kMaxObstacles, "obstacles"), "rigid things"),
       written_where(
           [](const Scene& s) { return !s.grips.empty(); },
           optional<Scene>("grips", &Scene::grips, list_of(object_of(grip()), 0, kMaxGrips, "grips"),
                           "points that are held or driven; with the solver \"mlsrk\"", "none")),
       optional<Scene>("probes", &Scene::probes, list_of(probe_codec(), 0, kMaxProbes, "probes"),
                       "time series of forces, of the state at places, of flux through planes"),
       optional<Scene>("seed", &Scene::seed, counter(), "of all random numbers"),
       optional<Scene>("jitter", &Scene::jitter, number("1", from_to(0, 1)),
                       "random shift of the initial points, over their distance"),
       written_where([](const Scene& s) { return s.quality != Quality::kOwn; },
                     optional<Scene>("quality", &Scene::quality, quality_codec(),
                                     "how well it is computed: numerics measured to be worth their time "
                                     "(docs/tradeoff.md); what \"numerics\" says itself wins",
                                     "none: the defaults of numerics")),
       switchable<Scene>("budget", &Scene::budget, budget(),
                         "in place of a quality: the time that the run may take, or an error to stay under"),
       numerics_field(),
       optional<Scene>("look", &Scene::look, object_of(look()), "what pictures show", "see look"),
       optional<Scene>("output", &Scene::output, object_of(output()), "pictures and files of every frame",
                       "see output")});
  return table;
}

std::vector<FieldInfo> document_fields() {
  return {{"lather",
           "version of the scene format",
           Presence::kRequired,
           "",
           "1",
           {{"const", std::int64_t{kSceneFormat}}},
           {},
           ""},
          {"sizes",
           "named changes of this scene, each merged into it (RFC 7396) when it is asked for: a list is "
           "replaced as a "
           "whole, null takes a key away",
           Presence::kOptional,
           "",
           "an object of objects",
           {{"type", "object"}, {"additionalProperties", Object{{"type", "object"}}}},
           {},
           "none"}};
}

}  // namespace lather::tables
