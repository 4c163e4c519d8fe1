// Meshes from files: read, checked and told what is wrong with them.

#include <gtest/gtest.h>

#include "sim/shape/mesh_solid.h"
#include "tests/unit/sim/shape/mesh_texts.h"
#include "tests/unit/sim/shape/samples.h"

namespace lather::test {
namespace {

TEST(MeshFile, OneCubeIsTheSameAsObjAndAsPlyInTextAndBinary) {
  for (const auto& [bytes, file] : {std::pair<std::string, std::string>{cube_obj(0.4), "a.obj"},
                                    {cube_ply(0.4, true), "a.PLY"},
                                    {cube_ply(0.4, false), "dir/a.ply"}}) {
    const MeshData mesh = closed_surface(read_mesh(bytes, file), file);
    EXPECT_EQ(mesh.positions.size(), 8U) << file;
    EXPECT_EQ(mesh.triangles.size(), 12U) << file;
    EXPECT_NEAR(enclosed_volume(mesh.positions, mesh.triangles), 0.064, 1e-8) << file;  // float corners
  }
}

TEST(MeshFile, PointsOfOnePlaceAreJoinedAndCollapsedFacesLeftOut) {
  // The ball has a point a face at its poles and a seam; faces there have two equal corners.
  const MeshData mesh = closed_surface(read_mesh(ball_obj(1, 16), "ball.obj"), "ball.obj");
  EXPECT_EQ(mesh.positions.size(), 16U * 7 + 2);
  EXPECT_EQ(mesh.triangles.size(), 2U * 16 * 6 + 2 * 16);
}

// At the nodes of its grid the distance is exact. In between it is linear: off by cell^2 / (8 R) where the
// sphere curves, far below the chord of the ball's facets, R (1 - cos(pi / turns)) squared over two
// directions. Both together stay below 1 % of R with 64 turns and cells of R / 32.
TEST(MeshSolid, OfABallHasTheDistanceOfTheSphere) {
  const MeshSolid ball(ball_obj(0.5, 64), "ball.obj", 64);
  std::mt19937_64 random(7);
  const Box3 around{Vec3::Constant(-0.53), Vec3::Constant(0.53)};
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 x = random_point(random, around);
    const double exact = x.norm() - 0.5;
    if (exact > 0.06) continue;  // outside the band
    EXPECT_NEAR(ball.distance(x), exact, 0.005) << x.transpose();
  }
}

TEST(MeshSolid, FarAwayItsDistanceIsABoundThatIsNotAboveTheTrueOne) {
  const MeshSolid ball(ball_obj(0.5, 32), "ball.obj", 32);
  std::mt19937_64 random(8);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 x = random_point(random, {Vec3::Constant(-3), Vec3::Constant(3)});
    const double exact = x.norm() - 0.5;
    if (exact < 0.06) continue;
    EXPECT_GT(ball.distance(x), 0.03) << x.transpose();
    EXPECT_LT(ball.distance(x), exact + 0.01) << x.transpose();  // the facets lie inside the sphere
  }
}

// A cube of 32 cells and faces on nodes of its grid: linear is exact off the edges.
TEST(MeshSolid, OfACubeIsExactAtItsFaces) {
  const MeshSolid cube(cube_ply(0.4, true), "cube.ply", 32);
  EXPECT_NEAR(cube.distance({0.21, 0.03, 0.05}), 0.01, 1e-6);
  EXPECT_NEAR(cube.distance({0.02, -0.17, 0.05}), -0.03, 1e-6);
  EXPECT_NEAR(cube.distance({0, 0, 0}), -0.2, 1e-6);
  EXPECT_EQ(cube.bounds().max, Vec3::Constant(static_cast<double>(0.2F)));
}

TEST(MeshSolid, IsDrawnAsItselfSmoothWhereFlatAndSharpAtEdges) {
  const TriangleMesh cube = MeshSolid(cube_obj(0.4), "cube.obj", 16).surface();
  EXPECT_EQ(cube.triangles.size(), 12U);
  EXPECT_EQ(cube.positions.size(), 24U);  // three normals at each corner
  const TriangleMesh ball = MeshSolid(ball_obj(0.5, 32), "ball.obj", 16).surface();
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    const Vec3 x(ball.positions[i][0], ball.positions[i][1], ball.positions[i][2]);
    const Vec3 n(ball.normals[i][0], ball.normals[i][1], ball.normals[i][2]);
    EXPECT_GT(n.dot(x.normalized()), 0.99);
  }
}

struct Broken {
  std::string claim;
  std::string file;
  std::string bytes;
  std::string says;
};
void PrintTo(const Broken& b, std::ostream* out) {
  *out << b.claim;
}

class BrokenMesh : public testing::TestWithParam<Broken> {};

TEST_P(BrokenMesh, IsRefusedWithThePlaceAndWhatToDo) {
  try {
    (void)MeshSolid(GetParam().bytes, GetParam().file, 16);
    FAIL() << "accepted";
  } catch (const MeshError& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(GetParam().says), std::string::npos) << what;
    EXPECT_NE(what.find(GetParam().file), std::string::npos) << what;
    EXPECT_FALSE(error.allowed.empty());
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}
std::string without_last_line(std::string text) {
  text.pop_back();
  return text.substr(0, text.rfind('\n') + 1);
}
const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenMesh,
    testing::Values(
        Broken{"a hole", "a.obj", without_last_line(cube_obj(1)), "a.obj, line 1"},
        Broken{"a hole, in words", "a.obj", without_last_line(cube_obj(1)), "not closed"},
        Broken{"no triangles", "a.obj", kCorners, "no triangles"},
        Broken{"no faces", "a.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
               "z\nend_header\n0 0 0\n",
               "cloud of points"},
        Broken{"an index too large", "a.obj", kCorners + "f 1 2 9\n", "line 5: the face asks for position 9"},
        Broken{"an index too large, PLY", "a.ply", replaced(cube_ply(1, false), "3 0 2 3", "3 0 2 8"),
               "face 1 asks for vertex 8"},
        Broken{"an index of 0", "a.obj", kCorners + "f 0 1 2\n", "counted from 1"},
        Broken{"an index before the first", "a.obj", kCorners + "f -5 -1 -2\n", "asks for position -5"},
        Broken{"a face of two corners", "a.obj", kCorners + "f 1 2\n", "line 5: a face needs three corners"},
        Broken{"NaN", "a.obj", replaced(kCorners, "v 1", "v nan") + "f 1 2 3\n", "line 2: a position needs"},
        Broken{"words", "a.obj", "v 0 zero 0\n", "\"zero\""},
        Broken{"infinite, PLY", "a.ply", replaced(cube_ply(1, false), "\n-0.5", "\ninf"), "vertex 1"},
        Broken{"one face turned", "a.obj", replaced(cube_obj(1), "f -8 -6 -5", "f -8 -5 -6"),
               "neighbouring faces look to opposite sides"},
        Broken{"inside out", "a.obj", kCorners + "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n", "inside out"},
        Broken{"three faces at an edge", "a.obj", cube_obj(1) + "v 2 2 2\nf -9 -7 -1\n",
               "more than two faces"},
        Broken{"flat", "a.obj", kCorners + "f 1 2 3\nf 1 3 2\n", "flat"},
        Broken{"cut short", "a.ply", cube_ply(1, true).substr(0, 420), "cut short"},
        Broken{"no PLY at all", "a.ply", "solid\n", "header line 1"},
        Broken{"big endian", "a.ply", replaced(cube_ply(1, true), "little", "big"), "binary_little_endian"},
        Broken{"a header without end", "a.ply", "ply\nformat ascii 1.0\n", "end_header"},
        Broken{"a list that claims more than there is", "a.ply",
               "ply\nformat ascii 1.0\nelement face 1\nproperty list uint int "
               "vertex_indices\nend_header\n4000000000 1\n",
               "element face, row 1"},
        Broken{"no known name", "a.stl", "solid", "neither an OBJ nor a PLY"},
        Broken{"too large", "a.obj", std::string(kMaxMeshBytes + 1, ' '), "too large"}),
    [](const testing::TestParamInfo<Broken>& one) { return std::to_string(one.index); });

}  // namespace
}  // namespace lather::test
