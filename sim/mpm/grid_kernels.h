#pragma once

// Block buffers and grid blocks: sum, copy, velocity update. Compiled per kernel level.

#include "sim/math/lane.h"
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
  return offset == 0  ? Overlap{0, kBufferBelow, kBlockWidth}
         : offset > 0 ? Overlap{kBlockWidth - kBufferBelow, 0, kBufferBelow}
                      : Overlap{0, kBufferBelow + kBlockWidth, kBufferWidth - kBufferBelow - kBlockWidth};
}

/// Calls row(node_offset, buffer_offset, reals) for every row that a grid block shares with the buffer of the
/// points' block at offset `o` from it; offsets count reals.
template <int Dim, class Row>
inline void for_shared_rows(const int (&o)[3], const Row& row) {
  using namespace mpm;
  const Overlap x = overlap_from_grid(o[0]);
  const Overlap y = overlap_from_grid(o[1]);
  const Overlap z = overlap_from_grid(o[2]);
  for (int i = 0; i < x.count; ++i) {
    if constexpr (Dim == 2) {
      row(((x.node + i) * kBlockWidth + y.node) * kQuad, ((x.buffer + i) * kBufferWidth + y.buffer) * kQuad,
          y.count * kQuad);
    } else {
      for (int j = 0; j < y.count; ++j)
        row((((x.node + i) * kBlockWidth + y.node + j) * kBlockWidth + z.node) * kQuad,
            (((x.buffer + i) * kBufferWidth + y.buffer + j) * kBufferWidth + z.buffer) * kQuad,
            z.count * kQuad);
    }
  }
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
    for_shared_rows<Dim>(o, [&](int to, int from, int reals) {
      for (int k = 0; k < reals; ++k) node[to + k] += buffer[from + k];
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
    for_shared_rows<Dim>(back, [&](int from, int to, int reals) {
      for (int k = 0; k < reals; ++k) buffer[to + k] = block[from + k];
    });
  }
  for (int k = mpm::kQuad * mpm::power(mpm::kBufferWidth, Dim); k < mpm::buffer_reals(Dim); ++k)
    buffer[k] = 0;
}

/// v* = v + dt (f/m + g) [Foam E.3 step 5; the paper prints it without v, which its FLIP update needs].
template <class Real, int Dim, bool Apic>
void update_grid(const mpm::StepConstants<Real>& step, Real* node, Real* increment) {
  for (int i = 0; i < mpm::block_nodes(Dim); ++i) {
    Real* q = node + i * mpm::kQuad;
    Real* dv = Apic ? nullptr : increment + i * mpm::kQuad;
    const Real mass = q[0];
    const bool carries = mass > mpm::kLeastMass<Real>;
    const Real per_mass = carries ? Real(1) / mass : Real(0);
    for (int a = 0; a < Dim; ++a) {
      const Real gravity = carries ? step.dt * step.gravity[a] : Real(0);
      if constexpr (Apic) {
        q[1 + a] = q[1 + a] * per_mass + gravity;
      } else {
        dv[1 + a] = dv[1 + a] * (step.dt * per_mass) + gravity;
        q[1 + a] = q[1 + a] * per_mass + dv[1 + a];
      }
    }
  }
}

}  // namespace lather::LATHER_LEVEL
