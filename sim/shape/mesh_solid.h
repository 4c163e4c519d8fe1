#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "sim/frame.h"
#include "sim/shape/mesh_file.h"

namespace lather {

/// Signed distance at the nodes of a regular grid, m.
struct DistanceGrid {
  Vec3 origin = Vec3::Zero();  ///< of the first node
  double cell = 1;             ///< m
  std::array<int, 3> nodes = {0, 0, 0};
  std::vector<float> values;  ///< x fastest
};

/// The distance of a closed mesh on a grid of `resolution` cells along its longest side: exact at nodes
/// inside and up to kOutsideCells cells outside, that value (a lower bound) further out. mesh_distance.cpp.
[[nodiscard]] DistanceGrid sample_distance(const MeshData& mesh, int resolution);
inline constexpr int kOutsideCells = 4;

/// A mesh as a solid: what MeshShape asks of it. Immutable.
class MeshSolid {
 public:
  /// Throws MeshError for bytes that are no closed surface.
  MeshSolid(std::string_view bytes, const std::string& file, int resolution);

  /// Signed distance, m: linear between the nodes of the grid, so off by up to about half a cell at edges and
  /// corners, where the nearest surface changes inside a cell, and by cell^2 over the radius of curvature / 8
  /// elsewhere. Beyond the grid a bound that is not above the true distance.
  [[nodiscard]] double distance(const Vec3& x) const;
  [[nodiscard]] Box3 bounds() const { return bounds_; }
  /// The mesh itself, for pictures: smooth where faces meet at less than 40 degrees, sharp elsewhere.
  [[nodiscard]] TriangleMesh surface() const;

 private:
  MeshData mesh_;
  Box3 bounds_;
  DistanceGrid grid_;
};

/// A file that a scene names, as it was read.
struct MeshFile {
  std::string file;
  std::string sha256;  ///< of the bytes
  std::string bytes;
};

}  // namespace lather
