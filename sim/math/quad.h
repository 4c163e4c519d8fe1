#pragma once

// Quads: four reals side by side, the components (mass and momentum, say) of a grid node, or the weights of a
// row of four nodes. Four nodes of four components are one lane. Compiled per kernel level, like lane.h.

#include <immintrin.h>

#include <utility>

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

namespace quad_detail {

template <class Packet, int... kIndex>
inline Packet pick(const Packet& a, const Packet& b, std::integer_sequence<int, kIndex...>) {
  return __builtin_shufflevector(a, b, kIndex...);
}

/// Of every four elements of a and b: a0 b0 a1 b1 from `first` = 0, a2 b2 a3 b3 from `first` = 2.
template <int first, int... i>
constexpr auto interleaved(std::integer_sequence<int, i...>) {
  return std::integer_sequence<int, i / 4 * 4 + first + i % 4 / 2 + i % 2 * int{sizeof...(i)}...>{};
}
/// Of every four elements of a and b: a0 a1 b0 b1 from `first` = 0, a2 a3 b2 b3 from `first` = 2.
template <int first, int... i>
constexpr auto joined(std::integer_sequence<int, i...>) {
  return std::integer_sequence<int, i / 4 * 4 + first + i % 2 + i % 4 / 2 * int{sizeof...(i)}...>{};
}

/// Of every four elements the first.
template <int... i>
constexpr auto firsts(std::integer_sequence<int, i...>) {
  return std::integer_sequence<int, i / 4 * 4 ...>{};
}

/// Transposes every 4 x 4 block of four packets.
template <int kSize, class Packet>
inline void transpose_blocks(Packet& a, Packet& b, Packet& c, Packet& d) {
  constexpr auto all = std::make_integer_sequence<int, kSize>{};
  const Packet ab0 = pick(a, b, interleaved<0>(all));
  const Packet cd0 = pick(c, d, interleaved<0>(all));
  const Packet ab2 = pick(a, b, interleaved<2>(all));
  const Packet cd2 = pick(c, d, interleaved<2>(all));
  a = pick(ab0, cd0, joined<0>(all));
  b = pick(ab0, cd0, joined<2>(all));
  c = pick(ab2, cd2, joined<0>(all));
  d = pick(ab2, cd2, joined<2>(all));
}

/// The quad again and again. A packet of two takes its `half`.
#ifdef __AVX512F__
inline void repeat_into(__m512& p, const float* quad, int) {
  p = _mm512_broadcast_f32x4(_mm_load_ps(quad));
}
inline void repeat_into(__m512d& p, const double* quad, int) {
  p = _mm512_broadcast_f64x4(_mm256_load_pd(quad));
}
#endif
#ifdef __AVX__
inline void repeat_into(__m256& p, const float* quad, int) {
  p = _mm256_broadcast_ps(reinterpret_cast<const __m128*>(quad));
}
inline void repeat_into(__m256d& p, const double* quad, int) {
  p = _mm256_load_pd(quad);
}
#endif
inline void repeat_into(__m128& p, const float* quad, int) {
  p = _mm_load_ps(quad);
}
inline void repeat_into(__m128d& p, const double* quad, int half) {
  p = _mm_load_pd(quad + 2 * half);
}

}  // namespace quad_detail

/// (q0 q1 q2 q3) four times over: one node's components at each of four nodes. A quad lies at a multiple of
/// its size.
template <class Real>
inline Lane<Real> repeat(const Real* quad) {
  Lane<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) quad_detail::repeat_into(r.p[i], quad, i % 2);
  return r;
}

/// (w0 w0 w0 w0 w1 w1 w1 w1 …): each node's weight at each of its components.
template <class Real>
inline Lane<Real> spread(const Real* quad) {
  using Packet = typename Lane<Real>::Packet;
  constexpr int n = Lane<Real>::kPacket;
  Lane<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) {
    if constexpr (n > 4)
      r.p[i] = Eigen::internal::ploadquad<Packet>(quad + i * n / 4);
    else
      r.p[i] = Eigen::internal::pset1<Packet>(quad[i * n / 4]);
  }
  return r;
}

/// (a0 a0 a0 a0 a4 a4 a4 a4 …): each node's first component at all of its components.
template <class Real>
inline Lane<Real> first_of_quads(const Lane<Real>& a) {
  constexpr int n = Lane<Real>::kPacket;
  Lane<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) {
    if constexpr (n < 4)
      r.p[i] = Eigen::internal::pset1<typename Lane<Real>::Packet>(a.p[i / 2 * 2][0]);
    else
      r.p[i] = quad_detail::pick(a.p[i], a.p[i], quad_detail::firsts(std::make_integer_sequence<int, n>{}));
  }
  return r;
}

/// Sum over the four nodes, component by component: nodes 0 + 2, 1 + 3, then both.
template <class Real>
inline void fold(const Lane<Real>& a, Real* quad) {
  using namespace Eigen::internal;
  if constexpr (Lane<Real>::kPacket == 2) {
    for (int half = 0; half < 2; ++half)
      pstoreu(quad + 2 * half, (a.p[half] + a.p[half + 4]) + (a.p[half + 2] + a.p[half + 6]));
  } else if constexpr (Lane<Real>::kPacket == 4) {
    pstoreu(quad, (a.p[0] + a.p[2]) + (a.p[1] + a.p[3]));
  } else if constexpr (Lane<Real>::kPacket == 8) {
    pstoreu(quad, predux_half_dowto4(a.p[0] + a.p[1]));
  } else {
    pstoreu(quad, predux_half_dowto4(predux_half_dowto4(a.p[0])));
  }
}

/// One quad for each of a tile's 16 points.
template <class Real>
class Quads {
 public:
  /// The points' first to fourth components.
  [[gnu::always_inline]] void put(const Lane<Real>& a, const Lane<Real>& b, const Lane<Real>& c,
                                  const Lane<Real>& d) {
    for (int i = 0; i < kPackets; ++i) {
      if constexpr (kSize < 4) {
        for (int k = 0; k < kSize; ++k) {
          Real* quad = (*this)[i * kSize + k];
          quad[0] = a.p[i][k];
          quad[1] = b.p[i][k];
          quad[2] = c.p[i][k];
          quad[3] = d.p[i][k];
        }
      } else {
        Packet q[4] = {a.p[i], b.p[i], c.p[i], d.p[i]};
        quad_detail::transpose_blocks<kSize>(q[0], q[1], q[2], q[3]);
        for (int r = 0; r < 4; ++r) Eigen::internal::pstore(values_ + (4 * i + r) * kSize, q[r]);
      }
    }
  }

  /// Point k's.
  const Real* operator[](int k) const { return values_ + at(k); }
  Real* operator[](int k) { return values_ + at(k); }

  /// The points' first to fourth components.
  [[gnu::always_inline]] void get(Lane<Real> (&components)[4]) const {
    for (int i = 0; i < kPackets; ++i) {
      if constexpr (kSize < 4) {
        for (int c = 0; c < 4; ++c)
          for (int k = 0; k < kSize; ++k) components[c].p[i][k] = (*this)[i * kSize + k][c];
      } else {
        Packet q[4];
        for (int r = 0; r < 4; ++r) q[r] = Eigen::internal::pload<Packet>(values_ + (4 * i + r) * kSize);
        quad_detail::transpose_blocks<kSize>(q[0], q[1], q[2], q[3]);
        for (int c = 0; c < 4; ++c) components[c].p[i] = q[c];
      }
    }
  }

 private:
  using Packet = typename Lane<Real>::Packet;
  static constexpr int kSize = Lane<Real>::kPacket;
  static constexpr int kPackets = Lane<Real>::kPackets;

  /// Where transposing packets by blocks of 4 x 4 leaves point k's quad.
  static constexpr int at(int k) {
    return kSize < 4 ? 4 * k : (k / kSize * 4 + k % 4) * kSize + k % kSize / 4 * 4;
  }
  alignas(64) Real values_[4 * kLanes];
};

}  // namespace lather::LATHER_LEVEL
