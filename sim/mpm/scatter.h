#pragma once

// From points to grid: mass, momentum [Foam E.3 step 1, Algorithm 6] and internal forces [steps 3 and 4,
// Algorithm 8], f_i = -sum_p V_p tau_p grad w_ip. Compiled per kernel level.
//
// A row of four nodes times (mass, x, y, z) is one lane of 16. The weights factorise, so a row costs one
// multiply-add for momentum and two for force once its plane's lanes are known.

#include "sim/mpm/stencil.h"
#include "sim/mpm/tear.h"

namespace lather::LATHER_LEVEL {

/// The points' mass and volume over those of a point as it was sampled: other than 1 only with resampling.
template <class Real, int Dim>
inline Lane<Real> load_share(const Tile<Real, Dim>& tile) {
  return tile.has(Field::kShare) ? tile.lane(Field::kShare) : Lane<Real>(Real(1));
}

/// What point k adds to the grid, as quads (mass, x, y, z): its mass and momentum; `pull[a]`, the factor of
/// the weight's derivative along axis a; `arm[a]`, the factor of weight times distance along a (APIC).
template <class Real, int Dim, bool Apic>
struct PointSources {
  alignas(64) Real mass[kLanes];
  alignas(64) Real momentum[Dim][kLanes];
  alignas(64) Real pull[Dim][Dim][kLanes];
  alignas(64) Real arm[Apic ? Dim : 1][Dim][kLanes];
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
    const Lane<Real> per_derivative = share * Real(-material.volume / step.cell * (Apic ? step.dt : Real(1)));
    const Lane<Real> t[3][3] = {{tau.xx, tau.xy, tau.xz}, {tau.xy, tau.yy, tau.yz}, {tau.xz, tau.yz, tau.zz}};
    m.store(mass);
    for (int a = 0; a < Dim; ++a) {
      (tile.lane(Field::kVelocity, a) * m).store(momentum[a]);
      for (int b = 0; b < Dim; ++b) (t[a][b] * per_derivative).store(pull[a][b]);
      if constexpr (Apic)
        for (int b = 0; b < Dim; ++b)
          (tile.lane(Field::kAffine, b * Dim + a) * (m * step.cell)).store(arm[a][b]);
    }
  }

  static Quad<Real> quad(Real first, const Real (&rest)[Dim][kLanes], int k) {
    return {{first, rest[0][k], rest[1][k], Dim == 3 ? rest[Dim - 1][k] : Real(0)}};
  }
};

template <class Real>
inline void add_row(Real* row, const Lane<Real>& value) {
  (Lane<Real>::load(row) + value).store(row);
}

/// Point k of a tile, FLIP: momentum and force to their own buffers.
template <class Real, int Dim, bool Cubic>
inline void scatter_flip(const Stencil<Real, Dim, Cubic>& s, const PointSources<Real, Dim, false>& p, int k,
                         Real* momentum, Real* force) {
  constexpr int last = Dim - 1;
  const Lane<Real> w_row = spread(s.row_weights(k));
  const Lane<Real> m = w_row * repeat(p.quad(p.mass[k], p.momentum, k));
  const Lane<Real> f_x = w_row * repeat(p.quad(Real(0), p.pull[0], k));
  const Lane<Real> f_last = spread(s.row_derivatives(k)) * repeat(p.quad(Real(0), p.pull[last], k));
  Real* m_row = momentum + s.base[k];
  Real* f_row = force + s.base[k];
  if constexpr (Dim == 2) {
    for (int i = 0; i < s.kNodes; ++i) {
      add_row(m_row + i * kRowStride, m * s.w[0][i][k]);
      add_row(f_row + i * kRowStride, f_x * s.d[0][i][k] + f_last * s.w[0][i][k]);
    }
  } else {
    const Lane<Real> f_y = w_row * repeat(p.quad(Real(0), p.pull[1], k));
    for (int i = 0; i < s.kNodes; ++i) {
      const Lane<Real> m_i = m * s.w[0][i][k];
      const Lane<Real> f_i = f_x * s.d[0][i][k] + f_last * s.w[0][i][k];
      const Lane<Real> f_yi = f_y * s.w[0][i][k];
      for (int j = 0; j < s.kNodes; ++j) {
        const int at = i * kPlaneStride + j * kRowStride;
        add_row(m_row + at, m_i * s.w[1][j][k]);
        add_row(f_row + at, f_i * s.w[1][j][k] + f_yi * s.d[1][j][k]);
      }
    }
  }
}

/// Point k of a tile, APIC: momentum with its affine part, and the force's impulse, to one buffer.
/// Momentum at node i is w m (v + C (x_i - x_p)) (Jiang et al. 2015).
template <class Real, int Dim, bool Cubic>
inline void scatter_apic(const Stencil<Real, Dim, Cubic>& s, const PointSources<Real, Dim, true>& p, int k,
                         Real* momentum) {
  constexpr int last = Dim - 1;
  const Lane<Real> w_row = spread(s.row_weights(k));
  const Lane<Real> m = w_row * repeat(p.quad(p.mass[k], p.momentum, k)) +
                       spread(s.row_arms(k)) * repeat(p.quad(Real(0), p.arm[last], k)) +
                       spread(s.row_derivatives(k)) * repeat(p.quad(Real(0), p.pull[last], k));
  const Lane<Real> arm_x = w_row * repeat(p.quad(Real(0), p.arm[0], k));
  const Lane<Real> f_x = w_row * repeat(p.quad(Real(0), p.pull[0], k));
  Real* row = momentum + s.base[k];
  if constexpr (Dim == 2) {
    for (int i = 0; i < s.kNodes; ++i)
      add_row(row + i * kRowStride, (m + arm_x * s.rel[0][i][k]) * s.w[0][i][k] + f_x * s.d[0][i][k]);
  } else {
    const Lane<Real> arm_y = w_row * repeat(p.quad(Real(0), p.arm[1], k));
    const Lane<Real> f_y = w_row * repeat(p.quad(Real(0), p.pull[1], k));
    for (int i = 0; i < s.kNodes; ++i) {
      const Lane<Real> m_i = (m + arm_x * s.rel[0][i][k]) * s.w[0][i][k] + f_x * s.d[0][i][k];
      const Lane<Real> arm_yi = arm_y * s.w[0][i][k];
      const Lane<Real> f_yi = f_y * s.w[0][i][k];
      for (int j = 0; j < s.kNodes; ++j) {
        const Real w = s.w[1][j][k];
        add_row(row + i * kPlaneStride + j * kRowStride,
                m_i * w + arm_yi * Real(w * s.rel[1][j][k]) + f_yi * s.d[1][j][k]);
      }
    }
  }
}

template <class Real, int Dim, bool Cubic, bool Apic>
Real scatter(const mpm::BlockPoints<Real>& points, const mpm::BlockPlace& place,
             const mpm::StepConstants<Real>& step, Real* momentum, Real* force) {
  Real stiffest(1);
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    const Stencil<Real, Dim, Cubic> stencil(tile, place);
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
