#pragma once

// Block buffers and grid blocks: sum, copy, velocity update. Compiled per kernel level.

#include <cstring>
#include <type_traits>

#include "sim/math/quad.h"
#include "sim/mpm/kernels.h"

namespace lather::LATHER_LEVEL {

/// Along one axis: which of a block's nodes meet which of the neighbouring block's buffer.
struct Overlap {
  int node;    ///< first node of the grid block
  int buffer;  ///< the same node in the buffer
  int count;
};

/// Grid block against the buffer of the points' block at `offset` (-1, 0, 1) from it.
constexpr Overlap overlap_from_grid(int offset) {
  using namespace mpm;
  static_assert(kBufferBelow + kBlockWidth + kBufferBelow == kBufferWidth);
  return offset == 0  ? Overlap{0, kBufferBelow, kBlockWidth}
         : offset > 0 ? Overlap{kBlockWidth - kBufferBelow, 0, kBufferBelow}
                      : Overlap{0, kBufferBelow + kBlockWidth, kBufferBelow};
}

/// Calls row(node_offset, buffer_offset, reals) for every row that a grid block shares with the buffer of the
/// points' block at offset `o` from it; offsets count reals, `reals` is the type of a constant.
template <int Dim, class Row>
inline void for_shared_rows(const int (&o)[3], const Row& row) {
  using namespace mpm;
  const Overlap x = overlap_from_grid(o[0]);
  const Overlap y = overlap_from_grid(o[1]);
  const Overlap z = overlap_from_grid(o[2]);
  const auto rows = [&](auto reals) {
    for (int i = 0; i < x.count; ++i) {
      if constexpr (Dim == 2) {
        row(((x.node + i) * kBlockWidth + y.node) * kQuad, ((x.buffer + i) * kBufferWidth + y.buffer) * kQuad,
            reals);
      } else {
        for (int j = 0; j < y.count; ++j)
          row((((x.node + i) * kBlockWidth + y.node + j) * kBlockWidth + z.node) * kQuad,
              (((x.buffer + i) * kBufferWidth + y.buffer + j) * kBufferWidth + z.buffer) * kQuad, reals);
      }
    }
  };
  if (o[Dim - 1] == 0)
    rows(std::integral_constant<int, kBlockWidth * kQuad>{});
  else
    rows(std::integral_constant<int, kBufferBelow * kQuad>{});
}

/// The offset of neighbour n of 3^Dim, last axis fastest.
template <int Dim>
inline void neighbour_offset(int n, int (&o)[3]) {
  o[2] = 0;
  for (int axis = Dim - 1; axis >= 0; --axis) {
    o[axis] = n % 3 - 1;
    n /= 3;
  }
}

template <class Real, int Dim>
void reduce(const Real* const* buffers, Real* node) {
  for (int k = 0; k < mpm::block_reals(Dim); ++k) node[k] = 0;
  for (int n = 0; n < mpm::neighbours(Dim); ++n) {
    if (buffers[n] == nullptr) continue;
    const Real* buffer = buffers[n];
    int o[3];
    neighbour_offset<Dim>(n, o);
    for_shared_rows<Dim>(o, [&](int to, int from, auto reals) {
      Real sum[reals];  // apart from both, which the compiler takes to overlap
      for (int k = 0; k < reals; ++k) sum[k] = node[to + k] + buffer[from + k];
      for (int k = 0; k < reals; ++k) node[to + k] = sum[k];
    });
  }
}

template <class Real, int Dim>
void collect(const Real* const* blocks, Real* buffer) {
  for (int n = 0; n < mpm::neighbours(Dim); ++n) {
    int o[3];
    neighbour_offset<Dim>(n, o);
    // Seen from the grid block at +o the buffer's own block lies at -o.
    const int back[3] = {-o[0], -o[1], -o[2]};
    const Real* block = blocks[n];
    for_shared_rows<Dim>(back, [&](int from, int to, auto reals) {
      std::memcpy(buffer + to, block + from, sizeof(Real) * reals);
    });
  }
  for (int k = mpm::kQuad * mpm::power(mpm::kBufferWidth, Dim); k < mpm::buffer_reals(Dim); ++k)
    buffer[k] = 0;
}

/// v* = v + dt (f/m + g) [Foam E.3 step 5; the paper prints it without v, which its FLIP update needs].
template <class Real, int Dim, bool Apic>
void update_grid(const mpm::StepConstants<Real>& step, Real* node, Real* increment) {
  const Lane<Real> zero(Real(0));
  const Real* g = step.gravity;
  alignas(64) const Real falls[4] = {0, step.dt * g[0], step.dt * g[1], Dim == 3 ? step.dt * g[2] : Real(0)};
  alignas(64) const Real masses[4] = {1, 0, 0, 0};
  const auto is_mass = repeat(masses) > zero;
  for (int k = 0; k < mpm::block_reals(Dim); k += kLanes) {
    const Lane<Real> q = Lane<Real>::load(node + k);
    const Lane<Real> mass = first_of_quads(q);
    const auto carries = mass > Lane<Real>(mpm::kLeastMass<Real>);
    const Lane<Real> per_mass = select(carries, Real(1) / mass, zero);
    const Lane<Real> gravity = select(carries, repeat(falls), zero);
    Lane<Real> dv = gravity;
    if constexpr (!Apic) {
      dv = Lane<Real>::load(increment + k) * (per_mass * step.dt) + gravity;
      dv.store(increment + k);
    }
    select(is_mass, q, q * per_mass + dv).store(node + k);
  }
}

}  // namespace lather::LATHER_LEVEL
