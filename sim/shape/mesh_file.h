#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Meshes as files hold them: OBJ, and PLY as text or in binary little endian.
namespace lather {

/// Triangles as they stand in a file. Polygons are cut into fans.
struct MeshData {
  std::vector<std::array<float, 3>> positions;          ///< m
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into `positions`
  std::vector<std::uint32_t> face;  ///< one a triangle: where it stands in the file, from 1
  std::string face_word = "face";   ///< what `face` counts: "line" or "face"
};

/// A mesh that cannot be used. what() says what is wrong, where in the file, and what to do.
class MeshError : public std::runtime_error {
 public:
  MeshError(const std::string& message, std::string wanted)
      : std::runtime_error(message), allowed(std::move(wanted)) {}
  std::string allowed;  ///< what a mesh must be here
};

inline constexpr std::size_t kMaxMeshBytes = std::size_t{32} << 20;  ///< of one file
inline constexpr std::size_t kMaxMeshTriangles = 2'000'000;

/// Reads the bytes of `file`, whose name ends in .obj or .ply. Throws MeshError.
[[nodiscard]] MeshData read_mesh(std::string_view bytes, const std::string& file);

/// The same for one format; `file` is for messages.
[[nodiscard]] MeshData read_obj(std::string_view bytes, const std::string& file);
[[nodiscard]] MeshData read_ply_mesh(std::string_view bytes, const std::string& file);

/// Joins positions that are equal bit for bit, leaves out triangles with two equal corners, and checks that
/// the rest is the closed surface of a solid: every edge between exactly two triangles that run along it in
/// opposite directions, facing outward. Throws MeshError naming the first face that is not so.
[[nodiscard]] MeshData closed_surface(MeshData mesh, const std::string& file);

/// Six times the volume is a sum over triangles of a . (b x c), by the divergence theorem; m^3, positive
/// where triangles face outward.
[[nodiscard]] double enclosed_volume(const std::vector<std::array<float, 3>>& positions,
                                     const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace lather
