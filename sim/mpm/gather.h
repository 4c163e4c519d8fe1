#pragma once

// From grid to points: velocities and their gradient, deformation, plastic flow. Compiled per kernel level.

#include "sim/mpm/read_rows.h"
#include "sim/mpm/tear.h"
#include "sim/particles/laws_on_tiles.h"

namespace lather::LATHER_LEVEL {

/// What the points of a tile read from the grid, as quads (any, x, y, z).
template <class Real, int Dim, bool Apic>
struct Gathered {
  Quads<Real> velocity;                ///< sum w v*, m/s: the PIC velocity
  Quads<Real> increment;               ///< FLIP: sum w (v* - v), m/s
  Quads<Real> gradient[Dim];           ///< [b]: sum v* d_b w, times the cell width, m/s
  Quads<Real> moment[Apic ? Dim : 1];  ///< [b]: sum w v* (x_i - x_p)_b, in cell widths, m/s
};

template <class Real, int Dim, bool Cubic, bool Apic>
inline void gather_point(const Stencil<Real, Dim, Cubic, Apic>& s, int k, const Real* velocity,
                         const Real* increment, Gathered<Real, Dim, Apic>& out) {
  const Lane<Real> w_row = spread(s.row_w[k]);
  const RowSums<Real, Dim, Cubic> rows(s, k, velocity);
  const Lane<Real> v = weighted(rows.x, s.w[0], k);
  fold(v * w_row, out.velocity[k]);
  fold_gradient(s, k, rows, v, out.gradient);
  if constexpr (Apic) {
    fold(weighted(rows.x, s.arm[0], k) * w_row, out.moment[0][k]);
    if constexpr (Dim == 3) fold(weighted(rows.y, s.arm[1], k) * w_row, out.moment[1][k]);
    fold(v * spread(s.row_arm[k]), out.moment[Dim - 1][k]);
  } else {
    fold(row_sum(s, k, increment) * w_row, out.increment[k]);
  }
}

/// [9. velocities] v = (1 - alpha) v_PIC + alpha (v + sum w (v* - v)) [Foam E.3 step 9, Algorithm 12];
/// APIC: v = v_PIC and C = (sum w v* (x_i - x_p)^T) D^-1 with D = moment * h^2.
template <class Real, int Dim, bool Cubic, bool Apic>
inline void update_velocities(const Tile<Real, Dim>& tile, const Gathered<Real, Dim, Apic>& g,
                              const mpm::StepConstants<Real>& step) {
  const Vectors<Real> pic(g.velocity);
  if constexpr (Apic) {
    for (int a = 0; a < Dim; ++a) tile.put(Field::kVelocity, a, pic[a]);
    const Real per_moment = Real(1) / (kernel_moment<Real>(Cubic) * step.cell);
    for (int b = 0; b < Dim; ++b) {
      const Vectors<Real> moment(g.moment[b]);
      for (int a = 0; a < Dim; ++a) tile.put(Field::kAffine, a * Dim + b, moment[a] * per_moment);
    }
  } else {
    const Vectors<Real> increment(g.increment);
    for (int a = 0; a < Dim; ++a) {
      const Lane<Real> flip = tile.lane(Field::kVelocity, a) + increment[a];
      tile.put(Field::kVelocity, a, pic[a] + (flip - pic[a]) * step.flip);
    }
  }
}

/// [7. deformation, 8. limit deformation, 10. plastic flow] What the law keeps and, where the material tears,
/// F over the step. [Foam E.3 steps 7, 8 and 10, Algorithms 11 and 13]
template <class Real, int Dim, bool Apic>
inline void update_deformation(const Tile<Real, Dim>& tile, const Gathered<Real, Dim, Apic>& g,
                               const mpm::MaterialConstants<Real>& material,
                               const mpm::StepConstants<Real>& step) {
  Mat3<Lane<Real>> A = scaled_columns(g.gradient, Real(step.dt / step.cell));  // dt grad v
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
    const Stencil<Real, Dim, Cubic, Apic> stencil(tile, place);
    Gathered<Real, Dim, Apic> gathered;
    for (int k = 0; k < kLanes; ++k)  // empty lanes repeat a point's place and stay harmless
      gather_point<Real, Dim, Cubic, Apic>(stencil, k, velocity, increment, gathered);
    update_velocities<Real, Dim, Cubic, Apic>(tile, gathered, step);
    update_deformation<Real, Dim, Apic>(tile, gathered, *points.material, step);
  }
}

}  // namespace lather::LATHER_LEVEL
