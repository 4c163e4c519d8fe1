#include "sim/surface/skin.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/ParticlesToLevelSet.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/math/vec.h"
#include "sim/shape/mesh_file.h"

namespace lather {
namespace {

// Lengths below are in voxels of half the points' distance.
constexpr double kVoxelsPerDistance = 2;
constexpr float kRadius = 2.5F;  ///< of the spheres in the union: 1.25 distances
constexpr float kInner = 0.9F;   ///< of what is left of a stray point: it holds a node of the grid
constexpr float kOuter = 2.0F;   ///< of the spheres outside which nothing is: one distance
/// From the smoothed union to the surface. Over a square lattice the spheres' mean height is
/// R - E[rho^2]/(2 R) - E[rho^4]/(8 R^3) = 1.181 distances, where the material ends at half a distance.
constexpr float kInset = 2 * (1.181F - 0.5F);
constexpr int kStrayReach = 3;  ///< half the side of the cube in which a stray point …
constexpr int kStrayPoints = 4;  ///< … has at most so many, itself counted: a drop, a strand of single points
constexpr float kBand = 3;       ///< half width of the distances that are kept

using Grid = openvdb::FloatGrid;

/// Points in voxels, as OpenVDB asks for them.
class Spheres {
 public:
  using PosType = openvdb::Vec3R;
  Spheres(const std::vector<std::array<float, 3>>& positions, const Vec3& origin, double voxel)
      : positions_(positions), origin_(origin), voxel_(voxel) {}
  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  // NOLINTNEXTLINE(readability-identifier-naming): OpenVDB's name
  void getPos(std::size_t n, PosType& out) const {
    for (int a = 0; a < 3; ++a)
      out[a] = (static_cast<double>(positions_[n][static_cast<std::size_t>(a)]) - origin_[a]) / voxel_;
  }

 private:
  const std::vector<std::array<float, 3>>& positions_;
  Vec3 origin_;
  double voxel_;
};

using Mask = openvdb::MaskTree;

openvdb::Coord voxel_of(const Spheres& spheres, std::size_t n) {
  openvdb::Vec3R at;
  spheres.getPos(n, at);
  return openvdb::Coord::round(at);
}

void grow(Mask& mask, int voxels) {
  openvdb::tools::dilateActiveValues(mask, voxels, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::IGNORE_TILES);
}
void shrink(Mask& mask, int voxels) {
  openvdb::tools::erodeActiveValues(mask, voxels, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                    openvdb::tools::IGNORE_TILES);
}

bool is_stray(const Mask& points, const openvdb::Coord& voxel) {
  const openvdb::tree::ValueAccessor<const Mask> at(points);
  int found = 0;
  for (int i = -kStrayReach; i <= kStrayReach; ++i)
    for (int j = -kStrayReach; j <= kStrayReach; ++j)
      for (int k = -kStrayReach; k <= kStrayReach; ++k)
        if (at.isValueOn(voxel.offsetBy(i, j, k)) && ++found > kStrayPoints) return false;
  return true;
}

struct Points {
  std::vector<std::array<float, 3>> near;   ///< that decide on the surface
  std::vector<std::array<float, 3>> stray;  ///< of these, the ones that smoothing would take away
  Mask filled;                              ///< voxels that are inside for certain
};

/// Most of the points of a body lie too deep in it to matter. The voxels within 2 of a point, less the
/// outermost layer, make up the material: of these, the ones more than 3 from the rest are filled, and a
/// sphere that covers any other voxel has its centre less than 6 from the rest, along each axis.
Points sorted_out(const std::vector<std::array<float, 3>>& positions, const Vec3& origin, double voxel) {
  const Spheres all(positions, origin, voxel);
  Mask points;
  for (std::size_t n = 0; n < all.size(); ++n) points.setValueOn(voxel_of(all, n));
  Mask deep = points;
  grow(deep, 2);
  shrink(deep, 1 + 3);
  Points out{{}, {}, deep};
  shrink(deep, 3);
  for (std::size_t n = 0; n < all.size(); ++n) {
    const openvdb::Coord at = voxel_of(all, n);
    if (deep.isValueOn(at)) continue;
    out.near.push_back(positions[n]);
    if (is_stray(points, at)) out.stray.push_back(positions[n]);
  }
  return out;
}

/// Distance from the nearest of the points less kRadius, within kBand; what is filled is inside.
Grid::Ptr sphere_union(const std::vector<std::array<float, 3>>& points, const Mask& filled,
                       const Vec3& origin, double voxel) {
  auto grid = openvdb::createLevelSet<Grid>(1.0, kBand);
  openvdb::tools::ParticlesToLevelSet<Grid> raster(*grid);
  raster.rasterizeSpheres(Spheres(points, origin, voxel), kRadius);
  for (auto leaf = filled.cbeginLeaf(); leaf; ++leaf) {
    auto& values = *grid->tree().touchLeaf(leaf->origin());
    for (auto at = leaf->cbeginValueOn(); at; ++at) values.setValueOff(at.pos(), -kBand);
  }
  raster.finalize(true);
  return grid;
}

/// Distance from the surface of the union. The distance from the nearest point is another one inside.
Grid::Ptr distance_from_surface(const Grid& spheres) {
  auto surface = openvdb::tools::sdfToSdf(spheres);
  openvdb::tree::LeafManager<Grid::TreeType> leaves(surface->tree());
  leaves.foreach ([](Grid::TreeType::LeafNodeType& leaf, std::size_t) {
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      const float distance = std::clamp(*voxel, -kBand, kBand);
      voxel.setValue(distance);
      if (std::abs(distance) >= kBand) voxel.setValueOff();
    }
  });
  openvdb::tools::pruneLevelSet(surface->tree());
  return surface;
}

/// Bounds of a field whose surface is still to be moved inward. No surface lies outside all spheres, and
/// stray points keep a sphere of their own.
void clamp_between_spheres(Grid& surface, const Grid& spheres, const Grid& stray) {
  const float inner = kInset - (kRadius - kInner);
  const float outer = kInset - (kRadius - kOuter);
  openvdb::tree::LeafManager<Grid::TreeType> leaves(surface.tree());
  leaves.foreach ([&](Grid::TreeType::LeafNodeType& leaf, std::size_t) {
    const auto at = spheres.getConstAccessor(), at_stray = stray.getConstAccessor();
    for (auto voxel = leaf.beginValueOn(); voxel; ++voxel) {
      const openvdb::Coord place = voxel.getCoord();
      voxel.setValue(
          std::min(std::max(*voxel, at.getValue(place) - outer), at_stray.getValue(place) - inner));
    }
  });
}

/// Area-weighted normals, outward.
void add_normals(TriangleMesh& mesh) {
  std::vector<Eigen::Vector3f> sums(mesh.positions.size(), Eigen::Vector3f::Zero());
  const auto at = [&](std::uint32_t i) {
    return Eigen::Map<const Eigen::Vector3f>(mesh.positions[i].data());
  };
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3f area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
    for (const std::uint32_t i : t) sums[i] += area;
  }
  mesh.normals.reserve(sums.size());
  for (const Eigen::Vector3f& sum : sums) {
    const float length = sum.norm();
    const Eigen::Vector3f n = length > 0 ? Eigen::Vector3f(sum / length) : Eigen::Vector3f::UnitY();
    mesh.normals.push_back({n.x(), n.y(), n.z()});
  }
}

TriangleMesh mesh_of(const Grid& surface, const Vec3& origin, double voxel) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(surface, points, quads, -static_cast<double>(kInset));
  TriangleMesh mesh;
  mesh.positions.reserve(points.size());
  for (const openvdb::Vec3s& p : points) {
    const Vec3 x = origin + voxel * Vec3(p[0], p[1], p[2]);
    mesh.positions.push_back(
        {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())});
  }
  mesh.triangles.reserve(2 * quads.size());
  for (const openvdb::Vec4I& q : quads) {  // OpenVDB's run clockwise seen from outside
    mesh.triangles.push_back({q[2], q[1], q[0]});
    mesh.triangles.push_back({q[3], q[2], q[0]});
  }
  add_normals(mesh);
  return mesh;
}

/// A corner near the points, on the lattice of voxels: coordinates stay small and single points do not move
/// others.
Vec3 origin_of(const std::vector<std::array<float, 3>>& positions, double voxel) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  for (const auto& p : positions) {
    const Vec3 x(p[0], p[1], p[2]);
    if (!x.allFinite()) throw std::runtime_error("There is no skin around points that are not finite.");
    low = low.cwiseMin(x);
  }
  return voxel * (low / voxel).array().floor();
}

}  // namespace

TriangleMesh skin_of(const std::vector<std::array<float, 3>>& positions, double distance, int threads) {
  if (positions.empty()) return {};
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(std::max(1, threads)));
  const double voxel = distance / kVoxelsPerDistance;
  const Vec3 origin = origin_of(positions, voxel);
  const Points points = sorted_out(positions, origin, voxel);
  const Grid::Ptr spheres = sphere_union(points.near, points.filled, origin, voxel);
  const Grid::Ptr stray = sphere_union(points.stray, Mask(), origin, voxel);
  const Grid::Ptr surface = distance_from_surface(*spheres);
  openvdb::tools::LevelSetFilter<Grid> filter(*surface);
  filter.setSpatialScheme(openvdb::math::FIRST_BIAS);  // WENO, the default, takes five times as long
  filter.gaussian(1);
  clamp_between_spheres(*surface, *spheres, *stray);
  return mesh_of(*surface, origin, voxel);
}

std::vector<FrameSkin> skins_of(const Frame& frame, int threads) {
  std::vector<FrameSkin> skins;
  const FramePoints& points = frame.points;
  for (std::size_t m = 0; m < frame.material_names.size(); ++m) {
    std::vector<std::array<float, 3>> own;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points.material[i] == m) own.push_back(points.position[i]);
    if (own.empty()) continue;
    auto mesh = std::make_shared<TriangleMesh>(skin_of(own, 2 * frame.point_radius, threads));
    const double volume = enclosed_volume(mesh->positions, mesh->triangles);
    skins.push_back({static_cast<std::uint8_t>(m), std::move(mesh), volume});
  }
  return skins;
}

}  // namespace lather
