#pragma once

#include <vector>

#include "sim/mpm/resample/conserved_values.h"
#include "sim/mpm/resample/point_values.h"
#include "sim/scene/scene.h"

namespace lather::mpm::resample {

/// Weights of the scene's kernel at a fraction of a cell, in [0, 1]: four into `weight`; returns the first
/// node's offset from the cell.
using KernelWeights = std::function<int(double fraction, double* weight)>;

/// The values of new points that are not conserved [Foam eqs. 19 and 20, Algorithm 20]: mass-weighted means
/// of the points of the same material on the nodes of the scene's grid, interpolated at the new point. Only
/// nodes that a new point reads are computed. be is renormalized.
///
/// With NewVelocity::kConserving velocity and affine velocity are instead the mean of the donors', weighted
/// by what they give, which conserves momentum.
///
/// Returns the values of point i as its set's PointValues lists them, from i * values_stride(sets) on.
template <class Real>
[[nodiscard]] std::vector<double> compute_new_field_values(const std::vector<NewPoint>& points,
                                                           const PointBins& bins,
                                                           const std::vector<ParticleSet<Real>>& sets,
                                                           const KernelWeights& weights, NewVelocity velocity,
                                                           int threads);

/// The longest of the sets' lists of values.
template <class Real>
[[nodiscard]] std::size_t values_stride(const std::vector<ParticleSet<Real>>& sets);

}  // namespace lather::mpm::resample
