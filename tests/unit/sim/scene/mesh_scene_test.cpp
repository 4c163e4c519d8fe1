// Scenes and plans with meshes: what is carried, and what it depends on.

#include <gtest/gtest.h>

#include "sim/plan/plan.h"
#include "sim/plan/seed.h"
#include "sim/shape/mesh_file.h"
#include "tests/unit/sim/scene/scene_texts.h"
#include "tests/unit/sim/shape/mesh_texts.h"

namespace lather::test {
namespace {

/// The small scene with a mesh for its ball.
std::string mesh_scene(const std::string& more = "") {
  return with("/bodies/0/shape",
              R"({"type": "mesh", "file": "ball.obj", "translate": [0.5, 0.5, 0.5])" + more + "}");
}

MeshSource source(double radius) {
  return [radius](const std::string& file) -> std::string {
    if (file != "ball.obj") throw MeshError("There is no file " + file + ".", "a file");
    return ball_obj(radius, 64);
  };
}

Problem problem_of(const std::string& text, const MeshSource& meshes) {
  try {
    (void)parse_scene(text, "", {}, meshes);
  } catch (const InputError& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted";
  return {};
}

// Facets take 0.4 % off the ball's volume; lattice places near its surface go either way, fewer than their
// square root.
TEST(MeshScene, ABallFromAFileIsSeededAsTheSphereIs) {
  const auto mesh = count_points(parse_scene(mesh_scene(), "", {}, source(0.2))).at_start;
  const auto sphere = count_points(parse_scene(small_scene())).at_start;
  EXPECT_NEAR(static_cast<double>(mesh[0]), static_cast<double>(sphere[0]),
              0.02 * static_cast<double>(sphere[0]));
}

TEST(MeshScene, TurnsScalesAndMovesAsOtherShapesDo) {
  const Scene s = parse_scene(mesh_scene(R"(, "scale": 0.5, "rotate_deg": [0, 30, 0])"), "", {}, source(0.4));
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.5, 0.5, 0.71}), 0.01, 2e-3);
  EXPECT_NEAR(distance(*s.bodies[0].shape, {0.5, 0.5, 0.5}), -0.2, 2e-3);
}

TEST(MeshScene, ItsHashDependsOnTheMeshsBytes) {
  const Scene small = parse_scene(mesh_scene(), "", {}, source(0.2));
  const Scene large = parse_scene(mesh_scene(), "", {}, source(0.21));
  EXPECT_NE(scene_hash(small), scene_hash(large));
  EXPECT_EQ(to_json(parse_scene(to_json(small), "", {}, source(0.2))), to_json(small));
}

TEST(MeshScene, AFileThatHasChangedSinceIsRefused) {
  const std::string written = to_json(parse_scene(mesh_scene(), "", {}, source(0.2)));
  const Problem problem = problem_of(written, source(0.21));
  EXPECT_EQ(problem.pointer, "/bodies/0/shape/sha256");
  EXPECT_NE(problem.message.find("have changed"), std::string::npos);
}

TEST(MeshScene, WithoutASourceOfMeshesItIsRefusedWithAWayOut) {
  const Problem problem = problem_of(mesh_scene(), {});
  EXPECT_EQ(problem.pointer, "/bodies/0/shape/file");
  EXPECT_NE(problem.message.find("by upload"), std::string::npos);
  EXPECT_NE(problem.message.find("lather run"), std::string::npos);
}

TEST(MeshScene, AMissingFileIsToldAtItsKey) {
  const Problem problem =
      problem_of(with("/obstacles/0/shape", R"({"type": "mesh", "file": "no.obj"})"), source(0.2));
  EXPECT_EQ(problem.pointer, "/obstacles/0/shape/file");
  EXPECT_NE(problem.message.find("no.obj"), std::string::npos);
}

TEST(MeshPlan, CarriesItsMeshesToTheMachineThatRunsIt) {
  const Plan plan = make_plan(parse_scene(mesh_scene(), "", {}, source(0.2)));
  const Plan back = read_plan(to_json(plan));
  EXPECT_EQ(to_json(back), to_json(plan));
  EXPECT_EQ(scene_hash(back.scene), scene_hash(plan.scene));
  EXPECT_EQ(back.points, plan.points);
}

}  // namespace
}  // namespace lather::test
