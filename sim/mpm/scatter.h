#pragma once

// From points to grid: mass, momentum [Foam E.3 step 1, Algorithm 6] and internal forces [steps 3 and 4,
// Algorithm 8], f_i = -sum_p V_p tau_p grad w_ip. Compiled per kernel level.
//
// A row of four nodes times (mass, x, y, z) is one lane of 16. The weights factorise into one part for each
// axis, so that what a point adds to row (i, j) is x_i w_j + y_j w_i: two multiply-adds a row, whether force,
// momentum, its affine part or all of them together.

#include "sim/mpm/stencil.h"
#include "sim/mpm/tear.h"

namespace lather::LATHER_LEVEL {

/// The points' mass and volume over those of a point as it was sampled: other than 1 only with resampling.
template <class Real, int Dim>
inline Lane<Real> load_share(const Tile<Real, Dim>& tile) {
  return tile.has(Field::kShare) ? tile.lane(Field::kShare) : Lane<Real>(Real(1));
}

/// Quads of `mass` and the vector whose component a is part(a).
template <int Dim, class Real, class Part>
inline void put_quads(Quads<Real>& to, const Lane<Real>& mass, const Part& part) {
  to.put(mass, part(0), part(1), Dim == 3 ? part(Dim - 1) : Lane<Real>(Real(0)));
}

/// pull[a] = (0, column a of `stress` times `factor`): what the weight's derivative along a multiplies.
template <int Dim, class Real>
inline void put_pull(Quads<Real> (&pull)[Dim], const Mat3<Lane<Real>>& stress, const Lane<Real>& factor) {
  for (int a = 0; a < Dim; ++a)
    put_quads<Dim>(pull[a], Lane<Real>(Real(0)), [&](int b) { return stress.m[b][a] * factor; });
}

/// What each point of a tile adds to the grid, as quads (mass, x, y, z): its mass and momentum; `pull[a]`,
/// the factor of the weight's derivative along axis a; `arm[a]`, the factor of weight times distance along a
/// (APIC).
template <class Real, int Dim, bool Apic>
struct PointSources {
  Quads<Real> momentum;
  Quads<Real> pull[Dim];
  Quads<Real> arm[Apic ? Dim : 1];
  Real stiffest;  ///< factor by which moduli are hardened, of any of the points

  PointSources(const Tile<Real, Dim>& tile, const mpm::MaterialConstants<Real>& material,
               const mpm::StepConstants<Real>& step) {
    alignas(64) Real rows[6][kLanes];
    stiffest = material.kernels.stress(point_tile(tile, material), rows[0]);
    const auto row = [&](int c) { return Lane<Real>::load(rows[c]); };
    Sym3<Lane<Real>> tau = {row(0), row(1), row(2), row(3), row(4), row(5)};
    if (tile.has(Field::kPlasticity)) limit_stress(tile, material.tearing, tau);
    const Lane<Real> share = load_share(tile);
    const Lane<Real> m = share * material.mass;
    const Real per_derivative = -material.volume / step.cell * (Apic ? step.dt : Real(1));
    put_quads<Dim>(momentum, m, [&](int a) { return tile.lane(Field::kVelocity, a) * m; });
    put_pull<Dim>(pull, full(tau), share * per_derivative);
    if constexpr (Apic)
      for (int a = 0; a < Dim; ++a)
        put_quads<Dim>(arm[a], Lane<Real>(Real(0)),
                       [&](int b) { return tile.lane(Field::kAffine, b * Dim + a) * (m * step.cell); });
  }
};

template <class Real>
inline void add_row(Real* row, const Lane<Real>& value) {
  (Lane<Real>::load(row) + value).store(row);
}

/// Adds `x(i) w_j + y(j) w_i` to row (i, j) of point k, in 2D `x(i)` to row i.
template <class Real, int Dim, bool Cubic, bool Apic, class X, class Y>
inline void scatter_rows(const Stencil<Real, Dim, Cubic, Apic>& s, int k, Real* rows, const X& x,
                         const Y& y) {
  if constexpr (Dim == 2) {
    for (int i = 0; i < s.kNodes; ++i) add_row(rows + i * kRowStride, x(i));
  } else {
    Lane<Real> y_j[nodes_per_axis(Cubic)];
    for (int j = 0; j < s.kNodes; ++j) y_j[j] = y(j);
    for (int i = 0; i < s.kNodes; ++i) {
      const Lane<Real> x_i = x(i);
      for (int j = 0; j < s.kNodes; ++j)
        add_row(rows + i * kPlaneStride + j * kRowStride, x_i * s.w[1][j][k] + y_j[j] * s.w[0][i][k]);
    }
  }
}

/// Adds sum_a pull[a] d_a w of point k.
template <class Real, int Dim, bool Cubic, bool Apic>
inline void scatter_pull(const Stencil<Real, Dim, Cubic, Apic>& s, const Quads<Real> (&pull)[Dim], int k,
                         Real* force) {
  const Lane<Real> w_row = spread(s.row_w[k]);
  const Lane<Real> f_x = w_row * repeat(pull[0][k]);
  const Lane<Real> f_y = w_row * repeat(pull[1][k]);  // in 3D only
  const Lane<Real> f_last = spread(s.row_d[k]) * repeat(pull[Dim - 1][k]);
  scatter_rows(
      s, k, force + s.base[k], [&](int i) { return f_x * s.d[0][i][k] + f_last * s.w[0][i][k]; },
      [&](int j) { return f_y * s.d[Dim - 2][j][k]; });
}

/// Point k of a tile, FLIP: momentum and force to their own buffers.
template <class Real, int Dim, bool Cubic>
inline void scatter_flip(const Stencil<Real, Dim, Cubic, false>& s, const PointSources<Real, Dim, false>& p,
                         int k, Real* momentum, Real* force) {
  const Lane<Real> m = spread(s.row_w[k]) * repeat(p.momentum[k]);
  Real* rows = momentum + s.base[k];
  for (int i = 0; i < s.kNodes; ++i) {
    const Lane<Real> m_i = m * s.w[0][i][k];
    if constexpr (Dim == 2) {
      add_row(rows + i * kRowStride, m_i);
    } else {
      for (int j = 0; j < s.kNodes; ++j)
        add_row(rows + i * kPlaneStride + j * kRowStride, m_i * s.w[1][j][k]);
    }
  }
  scatter_pull(s, p.pull, k, force);
}

/// Point k of a tile, APIC: momentum with its affine part, and the force's impulse, to one buffer.
/// Momentum at node i is w m (v + C (x_i - x_p)) (Jiang et al. 2015).
template <class Real, int Dim, bool Cubic>
inline void scatter_apic(const Stencil<Real, Dim, Cubic, true>& s, const PointSources<Real, Dim, true>& p,
                         int k, Real* momentum) {
  constexpr int last = Dim - 1;
  const Lane<Real> w_row = spread(s.row_w[k]);
  const Lane<Real> m = w_row * repeat(p.momentum[k]) + spread(s.row_arm[k]) * repeat(p.arm[last][k]) +
                       spread(s.row_d[k]) * repeat(p.pull[last][k]);
  const Lane<Real> arm_x = w_row * repeat(p.arm[0][k]);
  const Lane<Real> arm_y = w_row * repeat(p.arm[1][k]);  // in 3D only, as f_y
  const Lane<Real> f_x = w_row * repeat(p.pull[0][k]);
  const Lane<Real> f_y = w_row * repeat(p.pull[1][k]);
  scatter_rows(
      s, k, momentum + s.base[k],
      [&](int i) { return m * s.w[0][i][k] + arm_x * s.arm[0][i][k] + f_x * s.d[0][i][k]; },
      [&](int j) { return arm_y * s.arm[last - 1][j][k] + f_y * s.d[last - 1][j][k]; });
}

template <class Real, int Dim, bool Cubic, bool Apic>
Real scatter(const mpm::BlockPoints<Real>& points, const mpm::BlockPlace& place,
             const mpm::StepConstants<Real>& step, Real* momentum, Real* force) {
  Real stiffest(1);
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    const Stencil<Real, Dim, Cubic, Apic> stencil(tile, place);
    const PointSources<Real, Dim, Apic> sources(tile, *points.material, step);
    if (sources.stiffest > stiffest) stiffest = sources.stiffest;
    const int count = points.count - first < kLanes ? points.count - first : kLanes;
    for (int k = 0; k < count; ++k) {
      if constexpr (Apic)
        scatter_apic(stencil, sources, k, momentum);
      else
        scatter_flip(stencil, sources, k, momentum, force);
    }
  }
  return stiffest;
}

}  // namespace lather::LATHER_LEVEL
