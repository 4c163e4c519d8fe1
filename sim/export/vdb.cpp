#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/tools/MeshToVolume.h>

#include <sstream>

#include "sim/export/frame_files.h"

namespace lather {
namespace {

namespace points = openvdb::points;
using openvdb::Vec3f;

std::string whole_file(const openvdb::GridCPtrVec& grids, const Frame& frame) {
  openvdb::MetaMap about;
  about.insertMeta("lather_frame", openvdb::Int32Metadata(frame.index));
  about.insertMeta("lather_time", openvdb::DoubleMetadata(frame.time));
  std::ostringstream out(std::ios::binary);
  openvdb::io::Stream(out).write(grids, about);
  return std::move(out).str();
}

std::vector<Vec3f> vectors(const std::vector<std::array<float, 3>>& list) {
  std::vector<Vec3f> out;
  out.reserve(list.size());
  for (const auto& v : list) out.emplace_back(v[0], v[1], v[2]);
  return out;
}

/// Adds an attribute of type T to all points; `order` says where each point went.
template <class T>
void add(points::PointDataTree& tree, const openvdb::tools::PointIndexTree& order, const std::string& name,
         const std::vector<T>& values) {
  using Codec = points::NullCodec;
  points::appendAttribute<T, Codec>(tree, name);
  const points::PointAttributeVector<T> source(values);
  points::populateAttribute<points::PointDataTree, openvdb::tools::PointIndexTree,
                            points::PointAttributeVector<T>>(tree, order, name, source);
}

}  // namespace

std::string particles_vdb(const Frame& frame) {
  openvdb::initialize();
  const FramePoints& p = frame.points;
  const std::vector<Vec3f> positions = vectors(p.position);
  const points::PointAttributeVector<Vec3f> source(positions);
  // About eight points a voxel, as OpenVDB advises.
  const auto transform = openvdb::math::Transform::createLinearTransform(4 * frame.point_radius);
  const auto order = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(source, *transform);
  const auto grid =
      points::createPointDataGrid<points::NullCodec, points::PointDataGrid>(*order, source, *transform);
  add(grid->tree(), order->tree(), "v", vectors(p.velocity));
  add(grid->tree(), order->tree(), "id", std::vector<std::int32_t>(p.id.begin(), p.id.end()));
  add(grid->tree(), order->tree(), "material",
      std::vector<std::int32_t>(p.material.begin(), p.material.end()));
  for (const PointScalar& s : p.scalars) add(grid->tree(), order->tree(), s.name, s.values);
  grid->setName("points");
  return whole_file({grid}, frame);
}

std::string skin_vdb(const Frame& frame) {
  openvdb::initialize();
  const auto transform = openvdb::math::Transform::createLinearTransform(frame.point_radius);
  openvdb::GridCPtrVec grids;
  for (const FrameSkin& skin : frame.skins) {
    std::vector<openvdb::Vec3I> triangles;
    triangles.reserve(skin.mesh->triangles.size());
    for (const auto& t : skin.mesh->triangles) triangles.emplace_back(t[0], t[1], t[2]);
    const auto grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(
        *transform, vectors(skin.mesh->positions), triangles);
    grid->setName(frame.material_names[skin.material]);
    grids.push_back(grid);
  }
  return whole_file(grids, frame);
}

}  // namespace lather
