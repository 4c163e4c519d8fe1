#pragma once

// The wide vocabulary: 16 material points, or 4 grid nodes of 4 components, at once.
//
// This header is compiled once per kernel level (x86-64-v2, v3, v4) into the namespace lather::LATHER_LEVEL,
// with Eigen renamed likewise, so that no template instantiated for one instruction set is ever linked into
// another. Only files compiled per level may include it.
//
// Lane<Real> is built on Eigen's packets. Arithmetic is the compiler's own on those vector types: g++ 12
// fuses multiply-adds there and selects through masks, both of which Eigen::Array misses (its select is four
// times slower). The same functions exist for plain float and double: a law written once as a template on the
// value type is its own scalar twin.

#ifndef LATHER_LEVEL
#error "sim/math/lane.h is for files compiled once per kernel level"
#endif

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

namespace lather::LATHER_LEVEL {

inline constexpr int kLanes = 16;  ///< width of a tile at every level

template <class Real>
struct Lane {
  using Scalar = Real;
  using Packet = typename Eigen::internal::packet_traits<Real>::type;
  static constexpr int kPacket = Eigen::internal::unpacket_traits<Packet>::size;
  static constexpr int kPackets = kLanes / kPacket;
  using MaskPacket = decltype(Packet{} < Packet{});  ///< integers as wide as Real; all ones: true

  Packet p[kPackets];

  Lane() = default;
  Lane(Real value) {  // NOLINT(google-explicit-constructor): a scalar is a lane with equal entries
    for (Packet& q : p) q = Eigen::internal::pset1<Packet>(value);
  }
  static Lane load(const Real* from) {
    Lane r;
    for (int i = 0; i < kPackets; ++i) r.p[i] = Eigen::internal::ploadu<Packet>(from + i * kPacket);
    return r;
  }
  void store(Real* to) const {
    for (int i = 0; i < kPackets; ++i) Eigen::internal::pstoreu(to + i * kPacket, p[i]);
  }
  Lane& operator+=(const Lane& b) {
    for (int i = 0; i < kPackets; ++i) p[i] = p[i] + b.p[i];
    return *this;
  }
};

template <class Real>
struct Mask {
  typename Lane<Real>::MaskPacket p[Lane<Real>::kPackets];
};

#define LATHER_LANE_BINARY(op)                                                        \
  template <class Real>                                                               \
  inline Lane<Real> operator op(const Lane<Real>& a, const Lane<Real>& b) {           \
    Lane<Real> r;                                                                     \
    for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = a.p[i] op b.p[i];         \
    return r;                                                                         \
  }                                                                                   \
  template <class Real>                                                               \
  inline Lane<Real> operator op(const Lane<Real>& a, typename Lane<Real>::Scalar b) { \
    return a op Lane<Real>(b);                                                        \
  }                                                                                   \
  template <class Real>                                                               \
  inline Lane<Real> operator op(typename Lane<Real>::Scalar a, const Lane<Real>& b) { \
    return Lane<Real>(a) op b;                                                        \
  }
LATHER_LANE_BINARY(+)
LATHER_LANE_BINARY(-)
LATHER_LANE_BINARY(*)
LATHER_LANE_BINARY(/)
#undef LATHER_LANE_BINARY

#define LATHER_LANE_COMPARE(op)                                                       \
  template <class Real>                                                               \
  inline Mask<Real> operator op(const Lane<Real>& a, const Lane<Real>& b) {           \
    Mask<Real> r;                                                                     \
    for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = a.p[i] op b.p[i];         \
    return r;                                                                         \
  }                                                                                   \
  template <class Real>                                                               \
  inline Mask<Real> operator op(const Lane<Real>& a, typename Lane<Real>::Scalar b) { \
    return a op Lane<Real>(b);                                                        \
  }
LATHER_LANE_COMPARE(<)
LATHER_LANE_COMPARE(<=)
LATHER_LANE_COMPARE(>)
LATHER_LANE_COMPARE(>=)
#undef LATHER_LANE_COMPARE

template <class Real>
inline Lane<Real> operator-(const Lane<Real>& a) {
  Lane<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = -a.p[i];
  return r;
}
template <class Real>
inline Mask<Real> operator&(const Mask<Real>& a, const Mask<Real>& b) {
  Mask<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = a.p[i] & b.p[i];
  return r;
}
template <class Real>
inline Mask<Real> operator~(const Mask<Real>& a) {
  Mask<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = ~a.p[i];
  return r;
}
template <class Real>
inline Lane<Real> select(const Mask<Real>& mask, const Lane<Real>& yes, const Lane<Real>& no) {
  Lane<Real> r;
  for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = mask.p[i] ? yes.p[i] : no.p[i];
  return r;
}
template <class Real>
inline bool any(const Mask<Real>& mask) {
  using Bits = typename Eigen::internal::packet_traits<float>::type;  // as wide as a packet of Real
  static_assert(sizeof(Bits) == sizeof(mask.p[0]));
  auto either = mask.p[0];
  for (int i = 1; i < Lane<Real>::kPackets; ++i) either = either | mask.p[i];
  return Eigen::internal::predux_any(reinterpret_cast<Bits>(either));
}

#define LATHER_LANE_UNARY(name, packet_function)                                                      \
  template <class Real>                                                                               \
  inline Lane<Real> name(const Lane<Real>& a) {                                                       \
    Lane<Real> r;                                                                                     \
    for (int i = 0; i < Lane<Real>::kPackets; ++i) r.p[i] = Eigen::internal::packet_function(a.p[i]); \
    return r;                                                                                         \
  }
LATHER_LANE_UNARY(sqrt, psqrt)
LATHER_LANE_UNARY(abs, pabs)
LATHER_LANE_UNARY(exp, pexp)
LATHER_LANE_UNARY(log, plog)
#undef LATHER_LANE_UNARY

/// The larger, the smaller value; a NaN in `a` gives `b`, so no maximum may stand in for a test for NaN.
template <class Real>
inline Lane<Real> max(const Lane<Real>& a, const Lane<Real>& b) {
  return select(a > b, a, b);
}
template <class Real>
inline Lane<Real> min(const Lane<Real>& a, const Lane<Real>& b) {
  return select(a < b, a, b);
}

// The same vocabulary for one point.
inline float select(bool mask, float yes, float no) {
  return mask ? yes : no;
}
inline double select(bool mask, double yes, double no) {
  return mask ? yes : no;
}
inline bool any(bool mask) {
  return mask;
}
inline float sqrt(float a) {
  return __builtin_sqrtf(a);
}
inline double sqrt(double a) {
  return __builtin_sqrt(a);
}
inline float exp(float a) {
  return __builtin_expf(a);
}
inline double exp(double a) {
  return __builtin_exp(a);
}
inline float log(float a) {
  return __builtin_logf(a);
}
inline double log(double a) {
  return __builtin_log(a);
}
inline float abs(float a) {
  return __builtin_fabsf(a);
}
inline double abs(double a) {
  return __builtin_fabs(a);
}
inline float max(float a, float b) {
  return a > b ? a : b;
}
inline double max(double a, double b) {
  return a > b ? a : b;
}
inline float min(float a, float b) {
  return a < b ? a : b;
}
inline double min(double a, double b) {
  return a < b ? a : b;
}

/// log(1 + x) and exp(x) - 1 (for x above -80) with all digits of a small x: the rounding of 1 + x, of
/// exp(x), is divided out again (Kahan).
template <class T>
inline T log1p(const T& x) {
  const T u = T(1) + x;
  const T d = u - T(1);
  const auto exact = abs(d) > T(0);
  return select(exact, log(u) * (x / select(exact, d, T(1))), x);
}
template <class T>
inline T expm1(const T& x) {
  const T u = exp(x);
  const T l = log(u);
  const auto exact = abs(l) > T(0);
  return select(exact, (u - T(1)) * (x / select(exact, l, T(1))), x);
}

template <class T>
struct ScalarOf {
  using type = T;
};
template <class Real>
struct ScalarOf<Lane<Real>> {
  using type = Real;
};

/// How many values a T holds.
template <class T>
inline constexpr int kWidth = 1;
template <class Real>
inline constexpr int kWidth<Lane<Real>> = kLanes;

/// kWidth<T> values from `from` on.
template <class T>
inline T load(const typename ScalarOf<T>::type* from) {
  if constexpr (kWidth<T> == 1)
    return *from;
  else
    return T::load(from);
}

template <class T>
inline void store(const T& value, typename ScalarOf<T>::type* to) {
  if constexpr (kWidth<T> == 1)
    *to = value;
  else
    value.store(to);
}

}  // namespace lather::LATHER_LEVEL
