#pragma once

#include <array>
#include <vector>

#include "sim/frame.h"

namespace lather {

/// The surface of the material that points make up, after Bhattacharya, Gao, Bargteil 2011, "A level-set
/// method for skinning animated particle data": a signed distance that is smooth within bounds set by spheres
/// around the points.
///
/// With d the initial distance of neighbouring points, `distance` (m), and voxels of d/2:
///   1. the union of spheres of 1.25 d: whole inside, for the lattice's holes are 0.87 d from their points
///   2. smoothed by a Gaussian of 0.8 d, which takes out the bumps of single points
///   3. bounded: nowhere outside the union of spheres of d, moved outward with the surface; and a point with
///      fewer than four others around it (a drop, a strand), which smoothing would take away, keeps a sphere
///      of 0.45 d
///   4. moved inward, so that a flat face of the lattice ends half a distance outside its last points, where
///      its material does
/// Nothing is scaled to fit a volume.
///
/// Positions in m. Bit-equal for any number of threads. Throws std::runtime_error where a position is not
/// finite.
[[nodiscard]] TriangleMesh skin_of(const std::vector<std::array<float, 3>>& positions, double distance,
                                   int threads);

/// The skin of every material of a 3D frame that has points there.
[[nodiscard]] std::vector<FrameSkin> skins_of(const Frame& frame, int threads);

}  // namespace lather
