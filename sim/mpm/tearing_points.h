#pragma once

// Eigenvalues and tearing at one point, behind plain pointers. Compiled per kernel level. T is a plain real,
// or a lane that holds the point among points at rest.

#include "sim/material/tearing.h"
#include "sim/mpm/kernels.h"

namespace lather::LATHER_LEVEL {

/// The lane of the point; any would do.
inline constexpr int kPointLane = 5;

template <class T, class Real>
struct OnePoint {
  static T in(Real x) { return x; }
  static Real out(const T& x) { return x; }
};
template <class Real>
struct OnePoint<Lane<Real>, Real> {
  static Lane<Real> in(Real x) {
    Real values[kLanes] = {};
    values[kPointLane] = x;
    return Lane<Real>::load(values);
  }
  static Real out(const Lane<Real>& x) {
    Real values[kLanes];
    x.store(values);
    return values[kPointLane];
  }
};

template <class T, class Real>
struct TearingAtPoint {
  using Point = OnePoint<T, Real>;

  static Sym3<T> symmetric(const Real* a) {
    return {Point::in(a[0]), Point::in(a[1]), Point::in(a[2]),
            Point::in(a[3]), Point::in(a[4]), Point::in(a[5])};
  }
  static Mat3<T> matrix(const Real* a) {
    Mat3<T> m;
    for (int i = 0; i < 9; ++i) m.m[i / 3][i % 3] = Point::in(a[i]);
    return m;
  }
  static HerschelBulkleyState<T> state_of(const Real* s) { return {Point::in(s[0]), symmetric(s + 1)}; }
  static void put(const Mat3<T>& m, Real* to) {
    for (int i = 0; i < 9; ++i) to[i] = Point::out(m.m[i / 3][i % 3]);
  }

  static void pairs(const Real* a, Real* value, Real* vector) {
    const Eigenpairs<T> e = eigenpairs(symmetric(a));
    for (int k = 0; k < 3; ++k) {
      value[k] = Point::out(e.value[k]);
      for (int i = 0; i < 3; ++i) vector[3 * k + i] = Point::out(e.vector[k][i]);
    }
  }
  static Real largest(const Real* a) { return Point::out(largest_eigenvalue(symmetric(a))); }
  static void polar(const Real* A, Real* R) { put(polar_rotation_minus_identity(matrix(A)), R); }
  static void deformation(const Real* G, const Real* A, Real* to) { put(deformed(matrix(G), matrix(A)), to); }
  static Real plasticity(const Real* state, const Real* G) {
    return Point::out(accumulated_plasticity(state_of(state), matrix(G)));
  }
  static void stress(const Real* tau, Real* limited) {
    const Sym3<T> t = limited_stress(symmetric(tau));
    const T* entries[6] = {&t.xx, &t.yy, &t.zz, &t.xy, &t.xz, &t.yz};
    for (int i = 0; i < 6; ++i) limited[i] = Point::out(*entries[i]);
  }
  static void increment(const Real* state, const Real* A, Real* limited) {
    put(limited_increment(state_of(state), matrix(A)), limited);
  }
  static void recovery(const Real* state, const Real* G, Real exponent, Real* to) {
    put(recovered(state_of(state), matrix(G), T(exponent)), to);
  }
};

template <class T, class Real>
mpm::TearingKernels<Real> tearing_kernels() {
  using At = TearingAtPoint<T, Real>;
  return {At::pairs,      At::largest, At::polar,     At::deformation,
          At::plasticity, At::stress,  At::increment, At::recovery};
}

}  // namespace lather::LATHER_LEVEL
