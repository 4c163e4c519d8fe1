#pragma once

// What the internal forces of a block's points do to the grid's momentum as the grid moves with given
// velocities: the operator of the semi-implicit step, matrix-free. Compiled per kernel level.
//
//   impulse_i = -dt sum_p V_p Sigma_p grad w_ip,
//   Sigma     = a tau + b [kappa J^2 (tr D) I + mu dev(S be + be S)] + c [W tau - tau D] + rho nu A / dt
//
// with A = dt sum u_i grad w_i^T = D + W at each point (sim/material/elastic_tangent.h), rho = m_p / V_p, and
// the weights a, b, c and the diffusion nu of mpm::StiffnessTerms. Rows of four nodes are one lane of 16, as
// in scatter() and gather().
//
// Weak points [Foam section 7.2]: tau is the limited stress, as in the explicit force, and stays frozen over
// the step but for turning. Where such a point is expanded (J >= 1) it also adds no stiffness b: a torn
// place would else resist being opened further as a viscosity kappa dt does. A compressed one keeps it, or
// pressure there would be explicit and bound the step.

#include "sim/material/elastic_tangent.h"
#include "sim/mpm/scatter.h"

namespace lather::LATHER_LEVEL {

/// gradient[a][b][k] = sum u_a d_b w of point k, times the cell width.
template <class Real, int Dim, bool Cubic>
inline void gather_gradient(const Stencil<Real, Dim, Cubic>& s, int k, const Real* velocity,
                            Real (*gradient)[Dim][kLanes]) {
  constexpr int last = Dim - 1;
  const Lane<Real> zero(Real(0));
  Lane<Real> u = zero;   // sum over rows of w_x w_y times the row
  Lane<Real> dx = zero;  // … d_x w_y
  Lane<Real> dy = zero;  // … w_x d_y
  const Real* row = velocity + s.base[k];
  for (int i = 0; i < s.kNodes; ++i) {
    Lane<Real> sum = zero;
    if constexpr (Dim == 2) {
      sum = Lane<Real>::load(row + i * kRowStride);
    } else {
      Lane<Real> slope = zero;
      for (int j = 0; j < s.kNodes; ++j) {
        const Lane<Real> v = Lane<Real>::load(row + i * kPlaneStride + j * kRowStride);
        sum += v * s.w[1][j][k];
        slope += v * s.d[1][j][k];
      }
      dy += slope * s.w[0][i][k];
    }
    u += sum * s.w[0][i][k];
    dx += sum * s.d[0][i][k];
  }
  const auto put = [&](int b, const Quad<Real>& q) {
    for (int a = 0; a < Dim; ++a) gradient[a][b][k] = q.v[1 + a];
  };
  const Lane<Real> w_row = spread(s.row_weights(k));
  put(0, fold(dx * w_row));
  put(last, fold(u * spread(s.row_derivatives(k))));
  if constexpr (Dim == 3) put(1, fold(dy * w_row));
}

/// Adds sum_b pull[b][a] d_b w of point k to component a of the nodes around it.
template <class Real, int Dim, bool Cubic>
inline void scatter_pull(const Stencil<Real, Dim, Cubic>& s, const Real (*pull)[Dim][kLanes], int k,
                         Real* impulse) {
  constexpr int last = Dim - 1;
  const auto quad = [&](int b) {
    return repeat(Quad<Real>{{Real(0), pull[b][0][k], pull[b][1][k], Dim == 3 ? pull[b][last][k] : Real(0)}});
  };
  const Lane<Real> w_row = spread(s.row_weights(k));
  const Lane<Real> f_x = w_row * quad(0);
  const Lane<Real> f_last = spread(s.row_derivatives(k)) * quad(last);
  Real* row = impulse + s.base[k];
  if constexpr (Dim == 2) {
    for (int i = 0; i < s.kNodes; ++i)
      add_row(row + i * kRowStride, f_x * s.d[0][i][k] + f_last * s.w[0][i][k]);
  } else {
    const Lane<Real> f_y = w_row * quad(1);
    for (int i = 0; i < s.kNodes; ++i) {
      const Lane<Real> f_i = f_x * s.d[0][i][k] + f_last * s.w[0][i][k];
      const Lane<Real> f_yi = f_y * s.w[0][i][k];
      for (int j = 0; j < s.kNodes; ++j)
        add_row(row + i * kPlaneStride + j * kRowStride, f_i * s.w[1][j][k] + f_yi * s.d[1][j][k]);
    }
  }
}

/// A = dt grad u of a tile's points; plane strain in 2D.
template <class Real, int Dim, bool Cubic>
inline Mat3<Lane<Real>> deformation_increment(const Stencil<Real, Dim, Cubic>& stencil,
                                              const mpm::StepConstants<Real>& step, const Real* velocity) {
  alignas(64) Real gradient[Dim][Dim][kLanes];
  for (int k = 0; k < kLanes; ++k) gather_gradient<Real, Dim, Cubic>(stencil, k, velocity, gradient);
  Mat3<Lane<Real>> A;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      A.m[a][b] = a < Dim && b < Dim
                      ? Lane<Real>::load(gradient[a < Dim ? a : 0][b < Dim ? b : 0]) * (step.dt / step.cell)
                      : Lane<Real>(Real(0));
  return A;
}

template <class Real, int Dim, bool Cubic>
void stiffness(const mpm::BlockPoints<Real>& points, const mpm::BlockPlace& place,
               const mpm::StepConstants<Real>& step, const mpm::StiffnessTerms<Real>& terms,
               const Real* velocity, Real* impulse) {
  const mpm::MaterialConstants<Real>& material = *points.material;
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    const Stencil<Real, Dim, Cubic> stencil(tile, place);
    const HerschelBulkleyState<Lane<Real>> state = load_state(tile);
    const Lane<Real> per_derivative = load_share(tile) * Real(-step.dt * material.volume / step.cell);
    Sym3<Lane<Real>> tau = kirchhoff_stress(state, material.law.herschel_bulkley);
    Lane<Real> weight(terms.material);
    if (tile.has(Field::kPlasticity)) {
      limit_stress(tile, material.tearing, tau);
      const Lane<Real> zero(Real(0));
      weight = select(weak_points(tile, material.tearing) & (state.volume_change >= zero), zero, weight);
    }
    Sym3<Lane<Real>> even = scale(tau, Lane<Real>(terms.stress));  // the symmetric part of Sigma
    Mat3<Lane<Real>> A;
    const bool moves = terms.material != Real(0) || terms.geometric != Real(0) || terms.diffusion != Real(0);
    if (moves) {
      A = deformation_increment<Real, Dim, Cubic>(stencil, step, velocity);
      const Sym3<Lane<Real>> change = material_tangent(state, A, material.law.herschel_bulkley);
      even = {even.xx + change.xx * weight, even.yy + change.yy * weight, even.zz + change.zz * weight,
              even.xy + change.xy * weight, even.xz + change.xz * weight, even.yz + change.yz * weight};
    }
    Mat3<Lane<Real>> sigma = {
        {{even.xx, even.xy, even.xz}, {even.xy, even.yy, even.yz}, {even.xz, even.yz, even.zz}}};
    if (terms.diffusion != Real(0)) {
      const Real per_increment = terms.diffusion * material.mass / (material.volume * step.dt);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sigma.m[a][b] += A.m[a][b] * per_increment;
    }
    if (terms.geometric != Real(0)) {
      const Mat3<Lane<Real>> turned = geometric_tangent(tau, A);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sigma.m[a][b] += turned.m[a][b] * terms.geometric;
    }
    alignas(64) Real pull[Dim][Dim][kLanes];
    for (int a = 0; a < Dim; ++a)
      for (int b = 0; b < Dim; ++b) (sigma.m[a][b] * per_derivative).store(pull[b][a]);
    const int count = points.count - first < kLanes ? points.count - first : kLanes;
    for (int k = 0; k < count; ++k) scatter_pull<Real, Dim, Cubic>(stencil, pull, k, impulse);
  }
}

}  // namespace lather::LATHER_LEVEL
