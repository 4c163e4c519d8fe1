#pragma once

#include <string>

/// Meshes as the texts of files, for tests.
namespace lather::test {

/// A ball of `turns` by turns/2 faces around the origin, as OBJ with faces of four corners; its points lie on
/// the sphere.
[[nodiscard]] std::string ball_obj(double radius, int turns);

/// A cube of `side` around the origin, twelve triangles that face outward.
[[nodiscard]] std::string cube_obj(double side);

/// The same as binary little-endian PLY, or as text.
[[nodiscard]] std::string cube_ply(double side, bool binary);

}  // namespace lather::test
