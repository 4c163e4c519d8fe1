#pragma once

// The kernel Phi, made of cubic splines [MLSRK eq. 7]. Compiled per kernel level.

#include <limits>

#include "sim/math/lane.h"

namespace lather::LATHER_LEVEL {

/// Phi and its gradient by xi.
template <class T, int Dim>
struct Weight {
  T value;
  T gradient[Dim];
};

/// The cubic spline at s >= 0, and minus its derivative there: with q = (2 - s)+ and p = (1 - s)+ it is
/// q^3/6 - 2 p^3/3.
template <class T>
inline void cubic_spline(const T& s, T& value, T& descent) {
  using Real = typename ScalarOf<T>::type;
  const T zero(Real(0));
  const T q = max(T(Real(2)) - s, zero);
  const T p = max(T(Real(1)) - s, zero);
  const T qq = q * q;
  const T pp = p * p;
  value = qq * q * Real(1.0 / 6.0) - pp * p * Real(2.0 / 3.0);
  descent = qq * Real(0.5) - pp * Real(2);
}

/// A product of splines along the axes.
struct TensorWeight {
  /// Is the kernel above 0 there? A mask if T are lanes.
  template <class T, int Dim>
  static auto reaches(const T (&xi)[Dim]) {
    using Real = typename ScalarOf<T>::type;
    T largest = abs(xi[0]);
    for (int a = 1; a < Dim; ++a) largest = max(abs(xi[a]), largest);
    return largest < T(Real(2));
  }
  template <class T, int Dim>
  static Weight<T, Dim> at(const T (&xi)[Dim]) {
    using Real = typename ScalarOf<T>::type;
    T w[Dim];
    T d[Dim];
    for (int a = 0; a < Dim; ++a) {
      T descent;
      cubic_spline(abs(xi[a]), w[a], descent);
      d[a] = select(xi[a] < T(Real(0)), descent, -descent);
    }
    if constexpr (Dim == 2)
      return {w[0] * w[1], {d[0] * w[1], w[0] * d[1]}};
    else {
      const T xy = w[0] * w[1];
      return {xy * w[2], {d[0] * w[1] * w[2], w[0] * d[1] * w[2], xy * d[2]}};
    }
  }
};

/// A spline of the distance.
struct RadialWeight {
  template <class T, int Dim>
  static auto reaches(const T (&xi)[Dim]) {
    using Real = typename ScalarOf<T>::type;
    return squared_length(xi) < T(Real(4));
  }
  template <class T, int Dim>
  static Weight<T, Dim> at(const T (&xi)[Dim]) {
    using Real = typename ScalarOf<T>::type;
    const T s = sqrt(squared_length(xi));
    Weight<T, Dim> r;
    T descent;
    cubic_spline(s, r.value, descent);
    const T per_distance = -descent / max(s, T(std::numeric_limits<Real>::min()));  // xi is 0 where s is
    for (int a = 0; a < Dim; ++a) r.gradient[a] = per_distance * xi[a];
    return r;
  }

 private:
  template <class T, int Dim>
  static T squared_length(const T (&xi)[Dim]) {
    T sum = xi[0] * xi[0];
    for (int a = 1; a < Dim; ++a) sum = sum + xi[a] * xi[a];
    return sum;
  }
};

}  // namespace lather::LATHER_LEVEL
