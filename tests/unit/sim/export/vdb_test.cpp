// VDB files, read by OpenVDB itself.

#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/tools/LevelSetMeasure.h>

#include <sstream>

#include "sim/export/frame_files.h"
#include "sim/surface/skin.h"

namespace lather {
namespace {

/// A cube of 12^3 points, 10 mm apart, away from the origin.
Frame cube_frame() {
  Frame frame;
  frame.index = 7;
  frame.time = 0.25;
  frame.point_radius = 0.005;
  frame.material_names = {"foam"};
  frame.points.scalars.push_back({"J", "1", {}});
  for (std::uint32_t n = 0; n < 12 * 12 * 12; ++n) {
    const auto at = [](std::uint32_t i) { return 0.3F + 0.01F * static_cast<float>(i); };
    frame.points.position.push_back({at(n % 12), at(n / 12 % 12), at(n / 144)});
    frame.points.velocity.push_back({static_cast<float>(n), 0, 0});
    frame.points.id.push_back(n);
    frame.points.material.push_back(0);
    frame.points.scalars[0].values.push_back(0.5F + static_cast<float>(n));
  }
  frame.skins = skins_of(frame, 1);
  return frame;
}

openvdb::GridPtrVecPtr read(const std::string& bytes, openvdb::MetaMap::Ptr* about = nullptr) {
  std::istringstream in(bytes);
  openvdb::io::Stream stream(in);
  if (about != nullptr) *about = stream.getMetadata();
  return stream.getGrids();
}

TEST(Vdb, PointsKeepTheirPlacesAndAttributes) {
  const Frame frame = cube_frame();
  openvdb::MetaMap::Ptr about;
  const auto grids = read(particles_vdb(frame), &about);
  ASSERT_EQ(grids->size(), 1U);
  EXPECT_EQ(about->metaValue<double>("lather_time"), 0.25);
  EXPECT_EQ(about->metaValue<std::int32_t>("lather_frame"), 7);
  const auto points = openvdb::gridPtrCast<openvdb::points::PointDataGrid>(grids->at(0));
  EXPECT_EQ(openvdb::points::pointCount(points->tree()), frame.points.size());
  std::size_t seen = 0;
  for (auto leaf = points->tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::points::AttributeHandle<openvdb::Vec3f> place(leaf->constAttributeArray("P"));
    const openvdb::points::AttributeHandle<openvdb::Vec3f> velocity(leaf->constAttributeArray("v"));
    const openvdb::points::AttributeHandle<std::int32_t> id(leaf->constAttributeArray("id"));
    const openvdb::points::AttributeHandle<float> j(leaf->constAttributeArray("J"));
    for (auto at = leaf->beginIndexOn(); at; ++at, ++seen) {
      const openvdb::Vec3d x = points->indexToWorld(at.getCoord().asVec3d() + openvdb::Vec3d(place.get(*at)));
      const auto n = static_cast<std::size_t>(id.get(*at));
      // Within a voxel of 20 mm a float holds 2 nm.
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_NEAR(x[static_cast<int>(a)], static_cast<double>(frame.points.position[n][a]), 1e-8);
      EXPECT_EQ(velocity.get(*at)[0], static_cast<float>(n));
      EXPECT_EQ(j.get(*at), frame.points.scalars[0].values[n]);
    }
  }
  EXPECT_EQ(seen, frame.points.size());
}

// The level set is made from the mesh with voxels of the mesh's own size.
TEST(Vdb, TheSkinIsALevelSetOfTheSameVolumeNamedAfterItsMaterial) {
  const Frame frame = cube_frame();
  const auto grids = read(skin_vdb(frame));
  ASSERT_EQ(grids->size(), 1U);
  EXPECT_EQ(grids->at(0)->getName(), "foam");
  const auto level_set = openvdb::gridPtrCast<openvdb::FloatGrid>(grids->at(0));
  EXPECT_EQ(level_set->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_NEAR(openvdb::tools::levelSetVolume(*level_set) / frame.skins[0].volume, 1, 0.01);
}

}  // namespace
}  // namespace lather
