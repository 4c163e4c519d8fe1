#pragma once

#include <algorithm>
#include <vector>

#include "sim/material/drucker_prager_make.h"
#include "sim/material/snow_make.h"
#include "tests/unit/sim/material/plastic_states.h"

/// The two laws with a return mapping in principal stretches, each as its kernel and as its referee.
namespace lather::testing_support {

inline LogMap referee(const SnowParameters& p) {
  return [p](const Logs& log, double J_p) -> MappedLogs {
    const Logs after = log.exp().max(1 - p.critical_compression).min(1 + p.critical_stretch).log();
    return {after, J_p * std::exp((log - after).sum())};
  };
}

/// [MLSRK eq. 27, 28], step by step as they are printed.
inline LogMap referee(const DruckerPragerParameters& p, int dimension) {
  const double lambda = p.elastic.lame_lambda();
  const double mu = p.elastic.lame_mu();
  const double alpha = drucker_prager_alpha(p.friction_angle_deg, p.match, dimension);
  return [=](const Logs& log, double J_p) -> MappedLogs {
    const Logs eps = log + std::log(J_p) / dimension - p.cohesion;
    if (eps.sum() > 0) return {Logs::Constant(dimension, p.cohesion), std::exp(eps.sum())};
    const Logs dev = eps - eps.sum() / dimension;
    const double norm = dev.matrix().norm();
    const double delta = norm + (dimension * lambda + 2 * mu) / (2 * mu) * eps.sum() * alpha;
    if (delta <= 0 || norm == 0) return {eps + p.cohesion, 1};
    return {eps - delta * dev / norm + p.cohesion, 1};
  };
}

inline SnowParameters snow() {
  SnowParameters p;
  p.elastic = {400, 1.4e5, 0.2};
  return p;
}

/// Sand, cohesive soil matched in plane strain, a fluid.
inline std::vector<DruckerPragerParameters> grains() {
  DruckerPragerParameters sand;
  sand.elastic = {1600, 3.5e5, 0.3};
  sand.friction_angle_deg = 34;
  DruckerPragerParameters soil = sand;
  soil.elastic.poisson_ratio = 0;
  soil.friction_angle_deg = 20;
  soil.match = FrictionMatch::kPlaneStrain;
  soil.cohesion = 0.03;
  DruckerPragerParameters fluid = sand;
  fluid.elastic.poisson_ratio = 0.45;
  fluid.friction_angle_deg = 0;
  return {sand, soil, fluid};
}

template <class Real>
void yield(const LawPointKernels<Real>& kernels, const SnowParameters& p, PlasticStates<Real>& s) {
  kernels.snow(snow_constants<Real>(p), s.dimension, s.size(), s.G.data(), s.plastic_volume.data());
}
template <class Real>
void yield(const LawPointKernels<Real>& kernels, const DruckerPragerParameters& p, PlasticStates<Real>& s) {
  kernels.drucker_prager(drucker_prager_constants<Real>(p, s.dimension), s.dimension, s.size(), s.G.data(),
                         s.plastic_volume.data());
}

}  // namespace lather::testing_support
