// Frames as files of other programs, and frames made whole again from them.

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "sim/export/frame_files.h"
#include "sim/export/kept_frame.h"
#include "sim/shape/mesh_file.h"
#include "tests/support/run_scene.h"

namespace lather {
namespace {

/// A moving ball under a turning box, with a skin and two scalars.
Plan plan_with_files() {
  return make_plan(parse_scene(
      testing_support::ball_scene(), "",
      {{"/look/color_by", "J"},
       {"/output/scalars", "[\"plastic_strain\"]"},
       {"/output/skin", "[\"ply\"]"},
       {"/bodies/0/velocity", "[1, 0.5, -0.25]"},
       {"/obstacles",
        R"([{"name": "lid", "shape": {"type": "box", "size": [0.2, 0.2, 0.2], "translate": [0, 2, 0]},
                           "motion": {"type": "rotation", "rate_deg": 77}}])"}}));
}

Frame frame_of(const Plan& plan) {
  const auto simulation = Simulation::create(plan, 1);
  simulation->step_to_frame(1, [](const Progress&) { return true; });
  return simulation->frame();
}

/// A reader of its own: the header's words, then rows of 4-byte and 1-byte values as they lie there.
TEST(Export, ParticlesAreRowsOfABinaryPly) {
  const Plan plan = plan_with_files();
  const Frame frame = frame_of(plan);
  const std::string bytes = particles_ply(frame);
  const std::string end = "end_header\n";
  const std::size_t body = bytes.find(end) + end.size();
  EXPECT_EQ(bytes.substr(0, 36), "ply\nformat binary_little_endian 1.0\n");
  std::istringstream header(bytes.substr(0, body));
  std::vector<std::string> properties;
  for (std::string line; std::getline(header, line);)
    if (line.compare(0, 9, "property ") == 0) properties.push_back(line.substr(9));
  EXPECT_EQ(properties,
            (std::vector<std::string>{"float x", "float y", "float z", "float vx", "float vy", "float vz",
                                      "uint id", "uchar material", "float J", "float plastic_strain"}));
  constexpr std::size_t kRow = 6 * 4 + 4 + 1 + 2 * 4;
  ASSERT_EQ(bytes.size() - body, frame.points.size() * kRow);
  const std::size_t last = frame.points.size() - 1;
  const char* const row = bytes.data() + body + last * kRow;
  std::array<float, 3> x{};
  std::uint32_t id = 0;
  float j = 0;
  std::memcpy(x.data(), row, 12);
  std::memcpy(&id, row + 24, 4);
  std::memcpy(&j, row + 29, 4);
  EXPECT_EQ(x, frame.points.position[last]);
  EXPECT_EQ(id, frame.points.id[last]);
  EXPECT_EQ(j, frame.points.scalars[0].values[last]);
}

TEST(Export, AFrameIsWholeAgainFromItsParticlesAndTheScene) {
  const Plan plan = plan_with_files();
  const Frame frame = frame_of(plan);
  const Frame again = read_kept_frame(particles_ply(frame), Scenery(plan.scene));
  EXPECT_EQ(again.index, 1);
  EXPECT_EQ(again.time, frame.time);
  EXPECT_EQ(again.points.position, frame.points.position);
  EXPECT_EQ(again.points.velocity, frame.points.velocity);
  EXPECT_EQ(again.points.id, frame.points.id);
  EXPECT_EQ(again.points.material, frame.points.material);
  ASSERT_EQ(again.points.scalars.size(), 2U);
  EXPECT_EQ(again.points.scalars[1].name, "plastic_strain");
  EXPECT_EQ(again.points.scalars[1].unit, "1");
  EXPECT_EQ(again.points.scalars[1].values, frame.points.scalars[1].values);
  EXPECT_EQ(again.point_radius, frame.point_radius);
  EXPECT_EQ(again.floor_height, frame.floor_height);
  EXPECT_EQ(again.material_names, frame.material_names);
  ASSERT_EQ(again.obstacles.size(), 1U);
  EXPECT_EQ(again.obstacles[0].mesh->positions, frame.obstacles[0].mesh->positions);
  EXPECT_EQ(again.obstacles[0].pose.rotation.coeffs(), frame.obstacles[0].pose.rotation.coeffs());
}

TEST(Export, OtherPlyFilesAreNotTakenForKeptParticles) {
  const Plan plan = plan_with_files();
  EXPECT_THROW(
      (void)read_kept_frame("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n", Scenery(plan.scene)),
      std::runtime_error);
  Frame foreign = frame_of(plan);
  foreign.points.material[0] = 3;
  EXPECT_THROW((void)read_kept_frame(particles_ply(foreign), Scenery(plan.scene)), std::runtime_error);
}

// The meshes' own readers take what is written, with every number's bits.
TEST(Export, SkinsReadBackAsTheyWereFromObjAndPly) {
  const Frame frame = frame_of(plan_with_files());
  const TriangleMesh& skin = *frame.skins.at(0).mesh;
  for (const MeshData& mesh : {read_mesh(skin_obj(frame), "a.obj"), read_mesh(skin_ply(frame), "a.ply")}) {
    EXPECT_EQ(mesh.positions, skin.positions);
    EXPECT_EQ(mesh.triangles, skin.triangles);
  }
}

TEST(Export, SkinsOfSeveralMaterialsStandInOneFile) {
  Frame frame = frame_of(plan_with_files());
  frame.material_names.push_back("two words");
  frame.skins.push_back(frame.skins[0]);
  frame.skins[1].material = 1;
  const MeshData both = read_mesh(skin_ply(frame), "a.ply");
  EXPECT_EQ(both.positions.size(), 2 * frame.skins[0].mesh->positions.size());
  EXPECT_EQ(read_mesh(skin_obj(frame), "a.obj").triangles, both.triangles);
  EXPECT_NE(skin_obj(frame).find("\no two_words\n"), std::string::npos);
}

TEST(Export, FilesFollowTheOutputAndNothingElse) {
  EXPECT_TRUE(planned_files(Output{}).empty());
  Output output;
  output.particles = {"vdb"};
  output.skin = {"vdb", "obj"};
  std::string names;
  for (const FrameFileKind& kind : planned_files(output)) names += kind.folder + "." + kind.ending + " ";
  EXPECT_EQ(names, "particles.vdb skin.obj skin.vdb ");
}

}  // namespace
}  // namespace lather
