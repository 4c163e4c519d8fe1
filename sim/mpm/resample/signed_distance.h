#pragma once

#include <vector>

#include "sim/mpm/resample/point_bins.h"

namespace lather::mpm::resample {

/// The distance from the foam's surface, negative inside, on the nodes of the lattice [Foam Algorithm 2]. The
/// foam is the union of spheres of radius r around the points of all materials together: a void is where no
/// material is. Units of r.
///
/// Obstacles and walls are no material: to the foam they are outside, like air.
class SignedDistance {
 public:
  /// Magnitudes are known below this; where the surface is further away they are this.
  static constexpr float kBand = 4;

  SignedDistance(const PointBins& bins, NearestKernel kernel, int threads);

  /// The nodes of one of all blocks and the first ones beyond it, z fastest: (width + 1)^2 (depth + 1) values
  /// in 3D, (width + 1)^2 in 2D.
  void copy_nodes(std::size_t block, std::vector<float>& out) const;

 private:
  using Crossings = std::vector<Local>;  ///< points of the surface, each between two nodes

  void categorize(std::size_t block);
  [[nodiscard]] bool uniform_around(std::size_t block) const;
  [[nodiscard]] float nearest(std::size_t block, const std::array<int, 3>& node) const;
  void find_crossings(std::size_t block, Crossings& crossings) const;
  void measure(std::size_t block, const std::vector<Crossings>& crossings);

  [[nodiscard]] float* nodes(std::size_t block) {
    return distance_.data() + block * static_cast<std::size_t>(lattice_.cells());
  }
  [[nodiscard]] const float* nodes(std::size_t block) const {
    return distance_.data() + block * static_cast<std::size_t>(lattice_.cells());
  }

  const PointBins& bins_;
  Lattice lattice_;
  NearestKernel nearest_;
  std::vector<float> places_;    // [3][nodes of a block], relative to its corner
  std::vector<float> distance_;  // per block and node
  enum class Side : char { kOutside, kMixed, kInside };
  std::vector<Side> side_;  // per block: where its nodes lie
};

}  // namespace lather::mpm::resample
