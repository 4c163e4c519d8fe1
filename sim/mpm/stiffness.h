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
#include "sim/mpm/read_rows.h"
#include "sim/mpm/scatter.h"

namespace lather::LATHER_LEVEL {

/// A = dt grad u of a tile's points; plane strain in 2D.
template <class Real, int Dim, bool Cubic>
inline Mat3<Lane<Real>> deformation_increment(const Stencil<Real, Dim, Cubic, false>& stencil,
                                              const mpm::StepConstants<Real>& step, const Real* velocity) {
  Quads<Real> gradient[Dim];
  for (int k = 0; k < kLanes; ++k) {
    const RowSums<Real, Dim, Cubic> rows(stencil, k, velocity);
    fold_gradient(stencil, k, rows, weighted(rows.x, stencil.w[0], k), gradient);
  }
  return scaled_columns(gradient, Real(step.dt / step.cell));
}

template <class Real, int Dim, bool Cubic>
void stiffness(const mpm::BlockPoints<Real>& points, const mpm::BlockPlace& place,
               const mpm::StepConstants<Real>& step, const mpm::StiffnessTerms<Real>& terms,
               const Real* velocity, Real* impulse) {
  const mpm::MaterialConstants<Real>& material = *points.material;
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    const Stencil<Real, Dim, Cubic, false> stencil(tile, place);
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
    Quads<Real> pull[Dim];
    put_pull<Dim>(pull, sigma, per_derivative);
    const int count = points.count - first < kLanes ? points.count - first : kLanes;
    for (int k = 0; k < count; ++k) scatter_pull(stencil, pull, k, impulse);
  }
}

}  // namespace lather::LATHER_LEVEL
