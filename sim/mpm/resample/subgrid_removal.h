#pragma once

#include <vector>

#include "sim/mpm/resample/field_values.h"

namespace lather::mpm::resample {

/// Everything but the points that the removal of subgrid geometry reads.
struct SubgridSearch {
  SubgridRemoval thresholds;
  std::vector<double> tear_threshold;  ///< of each set; infinity: its points are never weak
  std::vector<double> mass;            ///< of a whole point of each set, kg
  KernelWeights weights;
  int reach = 2;  ///< half the kernel's support, cells, rounded up
};

/// The weak points whose surroundings are too thin for the grid [Foam section 7.4, eqs. 21 and 22, Algorithm
/// 15], as indices into the bins in ascending order. With the points q of all materials within the kernel's
/// support, weighted by w(x_q - x_p) m_q, the mean position p_p, and the covariance V_p about it, weighted by
/// the square of that, p goes if lambda_min(V_p) < anisotropy lambda_max(V_p) or lambda_max(V_p) < extent
/// h^2. The latter has no h^2 in the paper, whose value has a unit for that reason.
template <class Real>
[[nodiscard]] std::vector<std::uint32_t> find_subgrid_points(const PointBins& bins,
                                                             const std::vector<ParticleSet<Real>>& sets,
                                                             const SubgridSearch& search, int threads);

/// Takes the points away and returns their mass, kg. Sort the sets afterwards if there were any.
template <class Real>
double remove_points(const std::vector<std::uint32_t>& points, const PointBins& bins,
                     std::vector<ParticleSet<Real>>& sets, const std::vector<double>& mass);

}  // namespace lather::mpm::resample
