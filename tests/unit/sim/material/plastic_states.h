#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "sim/material/law_points.h"

/// Random states for plastic corrections, and a referee: the same mapping of logarithmic stretches in double
/// around Eigen's singular value decomposition.
namespace lather::testing_support {

/// At most 3 by 3, without allocation.
using Tensor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 3>;
using Logs = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, 3, 1>;

/// n points as the kernels take them.
template <class Real>
struct PlasticStates {
  int dimension = 3;
  std::vector<Real> G;               ///< F_e - I, 9 a point
  std::vector<Real> plastic_volume;  ///< J_p - 1

  [[nodiscard]] int size() const { return static_cast<int>(plastic_volume.size()); }
  [[nodiscard]] double entry(int point, int i, int j) const {
    return static_cast<double>(G[static_cast<std::size_t>(9 * point + 3 * i + j)]);
  }
  /// J_p
  [[nodiscard]] double plastic_ratio(int point) const {
    return 1 + static_cast<double>(plastic_volume[static_cast<std::size_t>(point)]);
  }
  /// F_e - I of as many rows as there are dimensions.
  [[nodiscard]] Tensor difference(int point) const {
    Tensor m(dimension, dimension);
    for (int i = 0; i < dimension; ++i)
      for (int j = 0; j < dimension; ++j) m(i, j) = entry(point, i, j);
    return m;
  }
  /// F_e
  [[nodiscard]] Tensor deformation(int point) const {
    return difference(point) + Tensor::Identity(dimension, dimension);
  }
  void push_back(const Tensor& m, double J_p) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        G.push_back(i < dimension && j < dimension ? static_cast<Real>(m(i, j) - (i == j ? 1 : 0)) : Real(0));
    plastic_volume.push_back(static_cast<Real>(J_p - 1));
  }
};

inline Tensor random_rotation(std::mt19937& rng, int dimension) {
  std::normal_distribution<double> normal;
  if (dimension == 2) return Eigen::Rotation2Dd(4 * normal(rng)).toRotationMatrix();
  return Eigen::Quaterniond(normal(rng), normal(rng), normal(rng), normal(rng))
      .normalized()
      .toRotationMatrix();
}

/// Stretches in four kinds, one after the other: 1 to within 1e-7 … 1e-2; within a factor of 1.6; between
/// 1e-3 and 1e3; the same, with two of them equal. Half of the points come with a J_p other than 1.
template <class Real>
PlasticStates<Real> random_states(int dimension, int count, unsigned seed) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  PlasticStates<Real> states;
  states.dimension = dimension;
  for (int n = 0; n < count; ++n) {
    const int kind = n % 4;
    const double range = kind == 0 ? std::pow(10, -4.5 + 2.5 * u(rng)) : kind == 1 ? 0.47 : std::log(1e3);
    Logs eps(dimension);
    for (double& e : eps) e = range * u(rng);
    if (kind == 3) eps(1) = eps(0);
    const Tensor U = random_rotation(rng, dimension);
    // Small strains without large rotations, which would round them.
    const Tensor V = kind == 0 ? U : random_rotation(rng, dimension);
    const Tensor F = U * Tensor(eps.exp().matrix().asDiagonal()) * V.transpose();
    states.push_back(F, n % 8 < 4 ? 1 : std::exp(range * u(rng) / 2));
  }
  return states;
}

struct MappedLogs {
  Logs log;
  double J_p;
};
using LogMap = std::function<MappedLogs(const Logs& log, double J_p)>;

/// What a state may be off by, in units of rounding. A stored G is rounded by its own size: that changes the
/// smallest stretch by the condition (1 + largest)/smallest, and all that follows from its logarithm.
inline double condition(const Logs& log) {
  return (1 + std::exp(log.maxCoeff())) / std::exp(log.minCoeff());
}

}  // namespace lather::testing_support
