#pragma once

// Lanes that a mask selects, stored one after the other. Compiled per kernel level, like lane.h; the
// instructions that move values across a register are not among Eigen's packets.

#include <immintrin.h>

#include <cstring>
#include <utility>

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// For each set of selected entries out of Count, where the entries of the packed packet come from, an entry
/// being of `Pieces` bytes or words.
template <int Count, int Pieces>
struct PackingTable {
  std::uint8_t from[1 << Count][Count * Pieces] = {};

  constexpr PackingTable() {
    for (int bits = 0; bits < 1 << Count; ++bits)
      for (int entry = 0, to = 0; entry < Count; ++entry)
        for (int p = 0; p < Pieces && (bits >> entry & 1) != 0; ++p)
          from[bits][to++] = static_cast<std::uint8_t>(entry * Pieces + p);
  }
};
template <int Count, int Pieces>
inline constexpr PackingTable<Count, Pieces> kPackingTable{};

/// Packs one packet. `order` says where the entries of the packed one come from.
template <class Real>
struct PacketPacking {
  using Packet = typename Lane<Real>::Packet;
  using MaskPacket = typename Lane<Real>::MaskPacket;
  static constexpr bool kFloat = sizeof(Real) == 4;
#if defined(__AVX512F__)
  unsigned bits;
  __m512i order;  ///< of entries

  explicit PacketPacking(const MaskPacket& mask) {
    __m512i m;
    std::memcpy(&m, &mask, sizeof m);
    if constexpr (kFloat) {
      bits = _mm512_movepi32_mask(m);
      const __m512i all = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
      order = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), all);
    } else {
      bits = _mm512_movepi64_mask(m);
      const __m512i all = _mm512_setr_epi64(0, 1, 2, 3, 4, 5, 6, 7);
      order = _mm512_maskz_compress_epi64(static_cast<__mmask8>(bits), all);
    }
  }
  void store(const Packet& v, Real* to) const {
    if constexpr (kFloat)
      _mm512_storeu_ps(to, _mm512_permutexvar_ps(order, v));
    else
      _mm512_storeu_pd(to, _mm512_permutexvar_pd(order, v));
  }
#elif defined(__AVX2__)
  unsigned bits;
  __m256i order;  ///< of words of 4 bytes

  explicit PacketPacking(const MaskPacket& mask) {
    __m256i m;
    std::memcpy(&m, &mask, sizeof m);
    if constexpr (kFloat)
      bits = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(m)));
    else
      bits = static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(m)));
    const std::uint8_t *words = kPackingTable < kFloat ? 8 : 4, kFloat ? 1 : 2 >.from[bits];
    order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(words)));
  }
  void store(const Packet& v, Real* to) const {
    __m256i words;
    std::memcpy(&words, &v, sizeof words);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(words, order));
  }
#else
  unsigned bits;
  __m128i order;  ///< of bytes

  explicit PacketPacking(const MaskPacket& mask) {
    __m128i m;
    std::memcpy(&m, &mask, sizeof m);
    if constexpr (kFloat)
      bits = static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(m)));
    else
      bits = static_cast<unsigned>(_mm_movemask_pd(_mm_castsi128_pd(m)));
    const std::uint8_t *bytes = kPackingTable < kFloat ? 4 : 2, kFloat ? 4 : 8 >.from[bits];
    order = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  }
  void store(const Packet& v, Real* to) const {
    __m128i bytes;
    std::memcpy(&bytes, &v, sizeof bytes);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(bytes, order));
  }
#endif
  [[nodiscard]] int count() const {
    return __builtin_popcount(bits);
  }
};

/// The values that a mask selects, in their order.
template <class T>
class Packing;

template <class Real>
class Packing<Lane<Real>> {
 public:
  explicit Packing(const Mask<Real>& mask)
      : Packing(mask, std::make_index_sequence<Lane<Real>::kPackets>()) {}

  [[nodiscard]] int count() const { return __builtin_popcount(bits()); }
  /// Writes count() values from `to` on, and anything behind them up to the sixteenth.
  void store(const Lane<Real>& v, Real* to) const {
    for (int i = 0; i < Lane<Real>::kPackets; ++i) {
      packets_[i].store(v.p[i], to);
      to += packets_[i].count();
    }
  }
  /// Likewise the numbers of the selected lanes, counted from `first`.
  void store_numbers(std::uint32_t first, std::uint32_t* to) const {
#if defined(__AVX512F__)
    const __m512i all =
        _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)),
                         _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits()), all));
#else
    unsigned left = bits();
    for (int half = 0; half < 2; ++half, left >>= 8U, first += 8) {
      const std::uint8_t* from = kPackingTable<8, 1>.from[left & 255U];
      const __m128i base = _mm_set1_epi32(static_cast<int>(first));
      for (int i = 0; i < 8; i += 4) {
        std::int32_t four;
        std::memcpy(&four, from + i, sizeof four);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to + i),
                         _mm_add_epi32(base, _mm_cvtepu8_epi32(_mm_cvtsi32_si128(four))));
      }
      to += __builtin_popcount(left & 255U);
    }
#endif
  }

 private:
  template <std::size_t... I>
  Packing(const Mask<Real>& mask, std::index_sequence<I...>) : packets_{PacketPacking<Real>(mask.p[I])...} {}

  /// Bit k is set where lane k is selected.
  [[nodiscard]] unsigned bits() const {
    unsigned all = 0;
    for (int i = 0; i < Lane<Real>::kPackets; ++i) all |= packets_[i].bits << (i * Lane<Real>::kPacket);
    return all;
  }

  PacketPacking<Real> packets_[Lane<Real>::kPackets];
};

template <class Real>
class ScalarPacking {
 public:
  explicit ScalarPacking(bool selected) : selected_(selected) {}
  [[nodiscard]] int count() const { return selected_ ? 1 : 0; }
  void store(Real v, Real* to) const { *to = v; }
  void store_numbers(std::uint32_t first, std::uint32_t* to) const { *to = first; }

 private:
  bool selected_;
};
template <>
class Packing<float> : public ScalarPacking<float> {
  using ScalarPacking<float>::ScalarPacking;
};
template <>
class Packing<double> : public ScalarPacking<double> {
  using ScalarPacking<double>::ScalarPacking;
};

}  // namespace lather::LATHER_LEVEL
