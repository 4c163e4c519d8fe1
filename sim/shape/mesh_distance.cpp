#include <omp.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>

#include <cmath>
#include <limits>

#include "sim/shape/mesh_solid.h"

namespace lather {
namespace {

/// The mesh in the grid's own coordinates, as OpenVDB asks for it.
class InGrid {
 public:
  InGrid(const MeshData& mesh, const DistanceGrid& grid) : mesh_(mesh), grid_(grid) {}
  // NOLINTBEGIN(readability-identifier-naming): OpenVDB's names
  [[nodiscard]] std::size_t polygonCount() const { return mesh_.triangles.size(); }
  [[nodiscard]] std::size_t pointCount() const { return mesh_.positions.size(); }
  [[nodiscard]] static std::size_t vertexCount(std::size_t /*polygon*/) { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& out) const {
    const auto& p = mesh_.positions[mesh_.triangles[polygon][corner]];
    for (int a = 0; a < 3; ++a)
      out[a] = (static_cast<double>(p[static_cast<std::size_t>(a)]) - grid_.origin[a]) / grid_.cell;
  }
  // NOLINTEND(readability-identifier-naming)

 private:
  const MeshData& mesh_;
  const DistanceGrid& grid_;
};

/// A grid around the mesh with room for the band outside it; no values yet.
DistanceGrid grid_around(const MeshData& mesh, int resolution) {
  const auto as_vec = [](const std::array<float, 3>& p) { return Vec3(p[0], p[1], p[2]); };
  Box3 box{as_vec(mesh.positions[0]), as_vec(mesh.positions[0])};
  for (const auto& p : mesh.positions) box.include(as_vec(p));
  DistanceGrid grid;
  grid.cell = box.extent().maxCoeff() / resolution;
  grid.origin = box.min - Vec3::Constant(kOutsideCells * grid.cell);
  for (int a = 0; a < 3; ++a)
    grid.nodes[static_cast<std::size_t>(a)] =
        static_cast<int>(std::ceil(box.extent()[a] / grid.cell)) + 2 * kOutsideCells + 1;
  return grid;
}

}  // namespace

DistanceGrid sample_distance(const MeshData& mesh, int resolution) {
  DistanceGrid grid = grid_around(mesh, resolution);
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(omp_get_max_threads()));
  const auto field = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
      InGrid(mesh, grid), openvdb::math::Transform(), static_cast<float>(kOutsideCells),
      std::numeric_limits<float>::max());
  const auto values = field->getConstAccessor();
  grid.values.reserve(static_cast<std::size_t>(grid.nodes[0]) * static_cast<std::size_t>(grid.nodes[1]) *
                      static_cast<std::size_t>(grid.nodes[2]));
  for (int k = 0; k < grid.nodes[2]; ++k)
    for (int j = 0; j < grid.nodes[1]; ++j)
      for (int i = 0; i < grid.nodes[0]; ++i)
        grid.values.push_back(values.getValue({i, j, k}) * static_cast<float>(grid.cell));
  return grid;
}

}  // namespace lather
