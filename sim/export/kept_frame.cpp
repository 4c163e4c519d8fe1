#include "sim/export/kept_frame.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "sim/shape/ply.h"

namespace lather {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error("these are not particles that a run kept: " + what);
}

/// What follows `key` in a comment, "" where none starts with it.
std::string comment(const PlyFile& ply, const std::string& key) {
  for (const std::string& line : ply.comments)
    if (line.compare(0, key.size(), key) == 0) return line.substr(key.size());
  return {};
}

const PlyColumn& column(const PlyElement& vertices, const std::string& name) {
  const PlyColumn* const found = vertices.find(name);
  if (found == nullptr || found->list) refuse("they have no \"" + name + "\"");
  return *found;
}

std::vector<std::array<float, 3>> vectors(const PlyElement& vertices,
                                          const std::array<const char*, 3>& names) {
  std::vector<std::array<float, 3>> out(vertices.rows);
  for (std::size_t a = 0; a < 3; ++a) {
    const PlyColumn& values = column(vertices, names[a]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i][a] = static_cast<float>(values.values[i]);
  }
  return out;
}

template <class T>
std::vector<T> whole_numbers(const PlyElement& vertices, const char* name) {
  std::vector<T> out;
  out.reserve(vertices.rows);
  for (const double value : column(vertices, name).values) out.push_back(static_cast<T>(value));
  return out;
}

/// All columns that a comment calls scalars.
std::vector<PointScalar> scalars(const PlyFile& ply, const PlyElement& vertices) {
  const std::string key = "lather scalar ";
  std::vector<PointScalar> out;
  for (const std::string& line : ply.comments) {
    if (line.compare(0, key.size(), key) != 0) continue;
    const std::size_t space = line.find(' ', key.size());
    if (space == std::string::npos) continue;
    const std::string name = line.substr(key.size(), space - key.size());
    const std::vector<double>& values = column(vertices, name).values;
    out.push_back({name, line.substr(space + 1), std::vector<float>(values.begin(), values.end())});
  }
  return out;
}

}  // namespace

Frame read_kept_frame(std::string_view particles_ply, const Scenery& scenery) {
  const PlyFile ply = read_ply(particles_ply);
  const std::string index = comment(ply, "lather frame "), time = comment(ply, "lather time ");
  const PlyElement* const vertices = ply.find("vertex");
  if (index.empty() || time.empty() || vertices == nullptr) refuse("they name no frame and time");
  Frame frame = scenery.frame(std::atoi(index.c_str()), std::strtod(time.c_str(), nullptr));
  frame.points.position = vectors(*vertices, {"x", "y", "z"});
  frame.points.velocity = vectors(*vertices, {"vx", "vy", "vz"});
  frame.points.id = whole_numbers<std::uint32_t>(*vertices, "id");
  frame.points.material = whole_numbers<std::uint8_t>(*vertices, "material");
  frame.points.scalars = scalars(ply, *vertices);
  for (const std::uint8_t material : frame.points.material)
    if (material >= frame.material_names.size())
      refuse("a point has a material that the scene does not have");
  return frame;
}

}  // namespace lather
