#pragma once

#include <array>
#include <vector>

#include "sim/frame.h"

namespace lather {

/// The surface of the material that points make up, after Bhattacharya, Gao, Bargteil 2011, "A level-set
/// method for skinning animated particle data": a signed distance as smooth as it can be between two bounds,
/// spheres around the points that are certainly inside and spheres beyond which there is certainly nothing.
///
/// With d the initial distance of neighbouring points, `distance` (m), and voxels of d/2:
///   1. the union of spheres of radius 1.25 d: whole inside, for the largest hole of the lattice is 0.87 d
///   from a point
///   2. smoothed by a Gaussian of 0.8 d, which takes out the bumps of single points
///   3. within the bounds, spheres of radius 0.45 d and d, both moved outward with the surface
///   4. moved inward, so that a flat face of the lattice ends half a distance outside its last points, where
///   the
///      material ends
/// Nothing is scaled to fit a volume. A point far from all others keeps a small sphere.
///
/// Positions in m. Bit-equal for any number of threads. Throws std::runtime_error where a position is not
/// finite.
[[nodiscard]] TriangleMesh skin_of(const std::vector<std::array<float, 3>>& positions, double distance,
                                   int threads);

/// The skin of every material of a 3D frame that has points there.
[[nodiscard]] std::vector<FrameSkin> skins_of(const Frame& frame, int threads);

}  // namespace lather
