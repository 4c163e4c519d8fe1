#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/math/vec.h"

namespace lather {

/// Triangles in their own frame, metres. Shared by all frames of a run.
struct TriangleMesh {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;  ///< one a position, unit length, outward
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A rigid placement: x_world = rotation * x_local + translation.
struct Pose {
  Quat rotation = Quat::Identity();
  Vec3 translation = Vec3::Zero();
};

/// One scalar carried by every point of a frame, for colour maps and export.
struct PointScalar {
  std::string name;           ///< "speed", "J", "plastic_strain", "plasticity", "weak", "concentration"
  std::string unit;           ///< "m/s", "1"
  std::vector<float> values;  ///< one a point
};

/// The points of one frame, all materials together, in ascending order of id within a material.
struct FramePoints {
  std::vector<std::array<float, 3>> position;  ///< m
  std::vector<std::array<float, 3>> velocity;  ///< m/s
  std::vector<std::uint32_t> id;               ///< stable over a run, unique over all materials
  std::vector<std::uint8_t> material;          ///< index into Frame::material_names
  std::vector<PointScalar> scalars;            ///< the ones the plan asked for

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

struct FrameObstacle {
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  Pose pose;  ///< at the frame's time
};

/// The surface of one material, as the scene asked for it.
struct FrameSkin {
  std::uint8_t material = 0;  ///< index into Frame::material_names
  std::shared_ptr<const TriangleMesh> mesh;
  double volume = 0;  ///< that the mesh encloses, m^3
};

/// One frame as an owned, single-precision snapshot: all that render and export may see of a simulation.
struct Frame {
  int index = 0;
  double time = 0;  ///< s
  int dimension = 3;
  double point_radius = 0;  ///< half the initial distance of points, m
  Box3 domain;
  double floor_height =
      0;  ///< y of the ground to draw: that of a level plane obstacle, else of the domain's bottom, m
  std::vector<std::string> material_names;
  FramePoints points;
  std::vector<FrameObstacle> obstacles;
  std::vector<FrameSkin> skins;  ///< of materials that have points; none where the scene asks for none
};

}  // namespace lather
