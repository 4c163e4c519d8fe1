#include <bit>
#include <cstdio>
#include <cstring>

#include "sim/export/frame_files.h"

namespace lather {
namespace {

static_assert(std::endian::native == std::endian::little, "binary PLY is written as memory holds it");

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// A line of a header must stay one.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return text;
}

std::string header_of(const Frame& frame) {
  char time[40];
  std::snprintf(time, sizeof time, "%.17g", frame.time);
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment lather frame " +
                       std::to_string(frame.index) + "\ncomment lather time " + time + "\n";
  for (std::size_t m = 0; m < frame.material_names.size(); ++m)
    header += "comment lather material " + std::to_string(m) + " " + one_line(frame.material_names[m]) + "\n";
  return header;
}

}  // namespace

std::string particles_ply(const Frame& frame) {
  const FramePoints& points = frame.points;
  std::string bytes = header_of(frame);
  for (const PointScalar& s : points.scalars)
    bytes += "comment lather scalar " + s.name + " " + s.unit + "\n";
  bytes += "element vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz"})
    bytes += std::string("property float ") + name + "\n";
  bytes += "property uint id\nproperty uchar material\n";
  for (const PointScalar& s : points.scalars) bytes += "property float " + s.name + "\n";
  bytes += "end_header\n";
  bytes.reserve(bytes.size() + points.size() * (29 + 4 * points.scalars.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    put(bytes, points.position[i]);
    put(bytes, points.velocity[i]);
    put(bytes, points.id[i]);
    put(bytes, points.material[i]);
    for (const PointScalar& s : points.scalars) put(bytes, s.values[i]);
  }
  return bytes;
}

std::string skin_ply(const Frame& frame) {
  std::size_t vertices = 0, faces = 0;
  for (const FrameSkin& skin : frame.skins) {
    vertices += skin.mesh->positions.size();
    faces += skin.mesh->triangles.size();
  }
  std::string bytes = header_of(frame) + "element vertex " + std::to_string(vertices) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
    bytes += std::string("property float ") + name + "\n";
  bytes += "element face " + std::to_string(faces) +
           "\nproperty list uchar uint vertex_indices\nproperty uchar material\nend_header\n";
  for (const FrameSkin& skin : frame.skins)
    for (std::size_t i = 0; i < skin.mesh->positions.size(); ++i) {
      put(bytes, skin.mesh->positions[i]);
      put(bytes, skin.mesh->normals[i]);
    }
  std::uint32_t first = 0;
  for (const FrameSkin& skin : frame.skins) {
    for (std::array<std::uint32_t, 3> t : skin.mesh->triangles) {
      for (std::uint32_t& i : t) i += first;
      put(bytes, std::uint8_t{3});
      put(bytes, t);
      put(bytes, skin.material);
    }
    first += static_cast<std::uint32_t>(skin.mesh->positions.size());
  }
  return bytes;
}

}  // namespace lather
