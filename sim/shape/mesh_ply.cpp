#include <cmath>

#include "sim/shape/mesh_file.h"
#include "sim/shape/ply.h"

namespace lather {
namespace {

constexpr const char* kAllowed =
    "a PLY file with elements vertex (x, y, z) and face (vertex_indices), ascii or binary_little_endian";

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw MeshError(file + ": " + what, kAllowed);
}

PlyFile parse(std::string_view bytes, const std::string& file) {
  try {
    return read_ply(bytes);
  } catch (const std::runtime_error& error) {
    refuse(file, error.what());
  }
}

void take_positions(const PlyElement& vertices, const std::string& file, MeshData& mesh) {
  std::array<const PlyColumn*, 3> columns{};
  for (std::size_t a = 0; a < 3; ++a) {
    const char* const name = a == 0 ? "x" : a == 1 ? "y" : "z";
    columns[a] = vertices.find(name);
    if (columns[a] == nullptr || columns[a]->list)
      refuse(file, std::string("its vertices have no \"") + name + "\". Export the mesh again.");
  }
  mesh.positions.resize(vertices.rows);
  for (std::size_t i = 0; i < vertices.rows; ++i)
    for (std::size_t a = 0; a < 3; ++a) {
      mesh.positions[i][a] = static_cast<float>(columns[a]->values[i]);
      if (!std::isfinite(mesh.positions[i][a]))
        refuse(file, "vertex " + std::to_string(i + 1) +
                         " has a coordinate that is not finite. Export the mesh again.");
    }
}

void take_face(const PlyColumn& corners, std::size_t row, const std::string& file, MeshData& mesh) {
  const std::size_t first = row == 0 ? 0 : corners.ends[row - 1];
  const std::size_t end = corners.ends[row];
  const std::string face = "face " + std::to_string(row + 1);
  if (end - first < 3) refuse(file, face + " has fewer than three corners.");
  for (std::size_t i = first; i < end; ++i)
    if (!(corners.values[i] >= 0) || corners.values[i] >= static_cast<double>(mesh.positions.size()))
      refuse(file, face + " asks for vertex " + std::to_string(static_cast<long long>(corners.values[i])) +
                       " (counted from 0), and the file has " + std::to_string(mesh.positions.size()) +
                       ". Export the mesh again.");
  const auto corner = [&](std::size_t i) { return static_cast<std::uint32_t>(corners.values[i]); };
  for (std::size_t i = first + 2; i < end; ++i) {
    mesh.triangles.push_back({corner(first), corner(i - 1), corner(i)});
    mesh.face.push_back(static_cast<std::uint32_t>(row + 1));
  }
}

}  // namespace

MeshData read_ply_mesh(std::string_view bytes, const std::string& file) {
  const PlyFile ply = parse(bytes, file);
  MeshData mesh;
  const PlyElement* const vertices = ply.find("vertex");
  if (vertices == nullptr) refuse(file, "it has no vertices. Export the mesh again.");
  take_positions(*vertices, file, mesh);
  const PlyElement* const faces = ply.find("face");
  if (faces == nullptr)
    refuse(file, "it has no faces: it is a cloud of points. Make a closed surface of it first.");
  const PlyColumn* corners = faces->find("vertex_indices");
  if (corners == nullptr) corners = faces->find("vertex_index");
  if (corners == nullptr || !corners->list) refuse(file, "its faces have no \"vertex_indices\".");
  for (std::size_t row = 0; row < faces->rows; ++row) take_face(*corners, row, file, mesh);
  return mesh;
}

}  // namespace lather
