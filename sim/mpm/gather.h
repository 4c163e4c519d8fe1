#pragma once

// From grid to points: velocities and their gradient, deformation, plastic flow. Compiled per kernel level.

#include "sim/mpm/scatter.h"
#include "sim/particles/laws_on_tiles.h"

namespace lather::LATHER_LEVEL {

/// What the points of a tile read from the grid.
template <class Real, int Dim, bool Apic>
struct Gathered {
  alignas(64) Real velocity[Dim][kLanes];              ///< sum w v*, m/s: the PIC velocity
  alignas(64) Real increment[Apic ? 1 : Dim][kLanes];  ///< sum w (v* - v), m/s
  alignas(64) Real gradient[Dim][Dim][kLanes];         ///< [a][b]: sum v*_a d_b w, times the cell width, m/s
  alignas(64)
      Real moment[Apic ? Dim : 1][Dim][kLanes];  ///< [a][b]: sum w v*_a (x_i - x_p)_b, in cell widths, m/s
};

template <class Real, int Dim>
inline void put(Real (*to)[kLanes], int k, const Quad<Real>& q) {
  for (int a = 0; a < Dim; ++a) to[a][k] = q.v[1 + a];
}
template <class Real, int Dim>
inline void put_column(Real (*to)[Dim][kLanes], int b, int k, const Quad<Real>& q) {
  for (int a = 0; a < Dim; ++a) to[a][b][k] = q.v[1 + a];
}

template <class Real, int Dim, bool Cubic, bool Apic>
inline void gather_point(const Stencil<Real, Dim, Cubic>& s, int k, const Real* velocity,
                         const Real* increment, Gathered<Real, Dim, Apic>& out) {
  constexpr int last = Dim - 1;
  const Lane<Real> zero(Real(0));
  Lane<Real> v = zero;      // sum over rows of w_x w_y times the row
  Lane<Real> dx = zero;     // … d_x w_y
  Lane<Real> dy = zero;     // … w_x d_y
  Lane<Real> arm_x = zero;  // … w_x rel_x w_y
  Lane<Real> arm_y = zero;  // … w_x w_y rel_y
  Lane<Real> dv = zero;
  const Real* v_row = velocity + s.base[k];
  const Real* dv_row = Apic ? nullptr : increment + s.base[k];
  for (int i = 0; i < s.kNodes; ++i) {
    const Real w_i = s.w[0][i][k];
    Lane<Real> sum;
    if constexpr (Dim == 2) {
      sum = Lane<Real>::load(v_row + i * kRowStride);
      if constexpr (!Apic) dv += Lane<Real>::load(dv_row + i * kRowStride) * w_i;
    } else {
      sum = zero;
      Lane<Real> slope = zero;
      Lane<Real> lever = zero;
      Lane<Real> change = zero;
      for (int j = 0; j < s.kNodes; ++j) {
        const Lane<Real> row = Lane<Real>::load(v_row + i * kPlaneStride + j * kRowStride);
        const Real w_j = s.w[1][j][k];
        sum += row * w_j;
        slope += row * s.d[1][j][k];
        if constexpr (Apic)
          lever += row * Real(w_j * s.rel[1][j][k]);
        else
          change += Lane<Real>::load(dv_row + i * kPlaneStride + j * kRowStride) * w_j;
      }
      dy += slope * w_i;
      if constexpr (Apic)
        arm_y += lever * w_i;
      else
        dv += change * w_i;
    }
    v += sum * w_i;
    dx += sum * s.d[0][i][k];
    if constexpr (Apic) arm_x += sum * Real(w_i * s.rel[0][i][k]);
  }
  const Lane<Real> w_row = spread(s.row_weights(k));
  put<Real, Dim>(out.velocity, k, fold(v * w_row));
  put_column<Real, Dim>(out.gradient, 0, k, fold(dx * w_row));
  put_column<Real, Dim>(out.gradient, last, k, fold(v * spread(s.row_derivatives(k))));
  if constexpr (Dim == 3) put_column<Real, Dim>(out.gradient, 1, k, fold(dy * w_row));
  if constexpr (Apic) {
    put_column<Real, Dim>(out.moment, 0, k, fold(arm_x * w_row));
    put_column<Real, Dim>(out.moment, last, k, fold(v * spread(s.row_arms(k))));
    if constexpr (Dim == 3) put_column<Real, Dim>(out.moment, 1, k, fold(arm_y * w_row));
  } else {
    put<Real, Dim>(out.increment, k, fold(dv * w_row));
  }
}

/// [9. velocities] v = (1 - alpha) v_PIC + alpha (v + sum w (v* - v)) [Foam E.3 step 9, Algorithm 12];
/// APIC: v = v_PIC and C = (sum w v* (x_i - x_p)^T) D^-1 with D = moment * h^2.
template <class Real, int Dim, bool Cubic, bool Apic>
inline void update_velocities(const Tile<Real, Dim>& tile, const Gathered<Real, Dim, Apic>& g,
                              const mpm::StepConstants<Real>& step) {
  for (int a = 0; a < Dim; ++a) {
    const Lane<Real> pic = Lane<Real>::load(g.velocity[a]);
    if constexpr (Apic) {
      tile.put(Field::kVelocity, a, pic);
      const Real per_moment = Real(1) / (kernel_moment<Real>(Cubic) * step.cell);
      for (int b = 0; b < Dim; ++b)
        tile.put(Field::kAffine, a * Dim + b, Lane<Real>::load(g.moment[a][b]) * per_moment);
    } else {
      const Lane<Real> flip = tile.lane(Field::kVelocity, a) + Lane<Real>::load(g.increment[a]);
      tile.put(Field::kVelocity, a, pic + (flip - pic) * step.flip);
    }
  }
}

/// [7. deformation, 8. limit deformation, 10. plastic flow] What the law keeps and, where the material tears,
/// F over the step. [Foam E.3 steps 7, 8 and 10, Algorithms 11 and 13]
template <class Real, int Dim, bool Apic>
inline void update_deformation(const Tile<Real, Dim>& tile, const Gathered<Real, Dim, Apic>& g,
                               const mpm::MaterialConstants<Real>& material,
                               const mpm::StepConstants<Real>& step) {
  Mat3<Lane<Real>> A = scaled_rows<Real, Dim>(g.gradient[0][0], Real(step.dt / step.cell));  // dt grad v
  if (tile.has(Field::kPlasticity)) {
    limit_increment(tile, material.tearing, A);
    store_deformation(tile, deformed(load_deformation(tile), A));
  }
  alignas(64) Real increment[9][kLanes];
  for (int c = 0; c < 9; ++c) A.m[c / 3][c % 3].store(increment[c]);
  material.kernels.deform(point_tile(tile, material), step.dt, increment[0]);
}

template <class Real, int Dim, bool Cubic, bool Apic>
void gather(const mpm::BlockPoints<Real>& points, const mpm::BlockPlace& place,
            const mpm::StepConstants<Real>& step, const Real* velocity, const Real* increment) {
  for (int first = 0; first < points.count; first += kLanes) {
    const Tile<Real, Dim> tile = tile_at<Real, Dim>(points, first);
    const Stencil<Real, Dim, Cubic> stencil(tile, place);
    Gathered<Real, Dim, Apic> gathered;
    for (int k = 0; k < kLanes; ++k)  // empty lanes repeat a point's place and stay harmless
      gather_point<Real, Dim, Cubic, Apic>(stencil, k, velocity, increment, gathered);
    update_velocities<Real, Dim, Cubic, Apic>(tile, gathered, step);
    update_deformation<Real, Dim, Apic>(tile, gathered, *points.material, step);
  }
}

}  // namespace lather::LATHER_LEVEL
