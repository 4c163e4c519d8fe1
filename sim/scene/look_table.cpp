#include <algorithm>

#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

namespace {

/// A camera with an eye is placed by hand, unless it says otherwise; then it needs both eye and target.
void check_camera(const Value& value, Look::Camera& c, const Place& place) {
  if (value.find("automatic") == nullptr)
    c.automatic = value.find("eye") == nullptr && value.find("target") == nullptr;
  if (c.automatic) return;
  for (const char* key : {"eye", "target"}) {
    if (value.find(key) != nullptr) continue;
    place.at(key).refuse(nullptr, "3 numbers, m",
                         std::string("A camera placed by hand needs \"") + key + "\".");
  }
  if (value.find("eye") != nullptr && value.find("target") != nullptr && (c.eye - c.target).norm() < 1e-9) {
    place.at("eye").refuse(value.find("eye"), "a point other than the target", "The camera looks nowhere.");
  }
}

/// The points' scalars lie inside a skin, not on it.
void check_look(const Value& value, Look& look, const Place& place) {
  if (look.style != "skin" || look.color_by == "material") return;
  place.at("color_by")
      .refuse(value.find("color_by"), "\"material\" with the style \"skin\"",
              "A skin is coloured by its material; draw points to see a scalar.");
}

/// Names of formats or scalars, each once.
Codec<std::vector<std::string>> names_of(const std::vector<std::string>& names) {
  Codec<std::vector<std::string>> codec = list_of(one_of(names), 0, names.size(), "of " + listed(names));
  codec.read = [read = codec.read, allowed = codec.allowed](const Value& value, std::vector<std::string>& out,
                                                            const Place& place) {
    if (!read(value, out, place)) return false;
    for (std::size_t i = 0; i < out.size(); ++i)
      if (std::find(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(i), out[i]) !=
          out.begin() + static_cast<std::ptrdiff_t>(i))
        return place.at(i).refuse(Value(out[i]), allowed, "\"" + out[i] + "\" is named twice.");
    return true;
  };
  return codec;
}

/// Two numbers, the smaller first; left out for "from each frame's own values".
Field<Look> color_range_field() {
  const Codec<double> bound = number("", from_to(-1e30, 1e30));
  Field<Look> out;
  out.info.name = "color_range";
  out.info.words = "values at the ends of the colour map, in the unit of color_by";
  out.info.allowed = "2 numbers, the first below the second";
  out.info.default_words = "from each frame's own values";
  out.info.schema = {{"type", "array"},
                     {"items", bound.schema},
                     {"minItems", std::int64_t{2}},
                     {"maxItems", std::int64_t{2}}};
  out.read = [bound, allowed = out.info.allowed](const Value& value, Look& look, const Place& place) {
    const Array* array = value.array();
    if (array == nullptr || array->size() != 2)
      return place.refuse(value, allowed, "This must be a list of 2.");
    std::array<double, 2> range{};
    const bool low = bound.read((*array)[0], range[0], place.at(std::size_t{0}));
    const bool high = bound.read((*array)[1], range[1], place.at(std::size_t{1}));
    if (!low || !high) return false;
    if (!(range[0] < range[1])) return place.refuse(value, allowed, "The range is empty.");
    look.color_range = range;
    return true;
  };
  out.write = [](const Look& look) {
    return look.color_range ? std::optional<Value>(Array{(*look.color_range)[0], (*look.color_range)[1]})
                            : std::nullopt;
  };
  return out;
}

}  // namespace

const Table<Look::Camera>& camera() {
  using C = Look::Camera;
  static const Table<C> table(
      "camera", "Where pictures are taken from; framed automatically where no eye is given.",
      {optional<C>("automatic", &C::automatic, flag(), "frame the domain's content over the whole motion",
                   "true without eye and target, else false"),
       optional<C>("eye", &C::eye, vector("m", from_to(-kMaxLength, kMaxLength)), "where the camera stands",
                   "chosen automatically"),
       optional<C>("target", &C::target, vector("m", from_to(-kMaxLength, kMaxLength)),
                   "the point it looks at", "chosen automatically"),
       optional<C>("field_of_view_deg", &C::field_of_view_deg, number("degrees", from_to(1, 150)),
                   "vertical")},
      {}, check_camera);
  return table;
}

const Table<Look>& look() {
  static const Table<Look> table(
      "look", "What pictures show; no influence on the simulation.",
      {optional<Look>("camera", &Look::camera, object_of(camera()), "where pictures are taken from",
                      "automatic"),
       optional<Look>("style", &Look::style, one_of({"points", "skin"}),
                      "draw the points, or the smooth surface around those of each material (3D)"),
       optional<Look>(
           "color_by", &Look::color_by,
           one_of({"material", "speed", "J", "plastic_strain", "plasticity", "weak", "concentration"}),
           "what the colour of a point shows"),
       color_range_field(),
       optional<Look>("color_map", &Look::color_map, one_of({"viridis", "inferno", "coolwarm", "gray"}),
                      "colours of a scalar"),
       optional<Look>("material_colors", &Look::material_colors, list_of(color(), 0, 255, "colours"),
                      "sRGB colours by material, in the order of the materials; none: a default palette"),
       optional<Look>("background", &Look::background, color(), "sRGB colour behind everything"),
       optional<Look>("floor", &Look::floor, flag(), "draw the domain's bottom"),
       optional<Look>("legend", &Look::legend, flag(), "draw the legend of a scalar"),
       optional<Look>("shadows", &Look::shadows, flag(), "draw shadows"),
       optional<Look>("point_scale", &Look::point_scale, number("1", from_to(0.01, 100)),
                      "drawn radius over half the initial distance of points")},
      {}, check_look);
  return table;
}

const Table<Output>& output() {
  static const Table<Output> table(
      "output", "The pictures' size, and the files that are written beside every frame.",
      {optional<Output>("width", &Output::width, integer(16, 16384), "pixels across"),
       optional<Output>("height", &Output::height, integer(16, 16384), "pixels down"),
       optional<Output>("supersampling", &Output::supersampling, integer(1, 8), "samples per pixel and axis"),
       optional<Output>(
           "particles", &Output::particles, names_of({"ply", "vdb"}),
           "files of the points, particles/NNNNN: positions, velocities, ids, materials, scalars"),
       optional<Output>("skin", &Output::skin, names_of({"obj", "ply", "vdb"}),
                        "files of the surface around the points of each material (3D), skin/NNNNN"),
       optional<Output>("scalars", &Output::scalars,
                        names_of({"speed", "J", "plastic_strain", "plasticity", "weak", "concentration"}),
                        "scalars that the files of the points carry beside the one of color_by")});
  return table;
}

}  // namespace lather::tables
