#pragma once

// Elasto-viscoplastic Herschel-Bulkley law of "Continuum Foam: A Material Point Method for Shear-Dependent
// Flows" (Yue et al. 2015), here [Foam], on lanes of material points or on one point. Compiled per kernel
// level.
//
//   W    = kappa/2 [ (J^2 - 1)/2 - ln J ] + mu/2 (tr be - 3)            [Foam eq. 1]
//   tau  = kappa/2 (J^2 - 1) I + mu dev be                              [Foam eq. 2]
//   Phi  = s - sqrt(2/3) sigma_Y,  s = |mu dev be|_F                     [Foam eq. 3]
//   flow = (Phi / eta)^(1/h)                                            [Foam eq. 7]
//
// be is the elastic left Cauchy-Green tensor scaled to unit determinant (b-bar-e in the paper). The state
// holds differences, J - 1 and B = be - I: oobleck yields at a strain of 1e-5, which a float that holds be
// itself cannot see. h is the flow index here, never a length.

#include <iterator>

#include "sim/material/herschel_bulkley_constants.h"
#include "sim/math/inverse_cube_root.h"
#include "sim/math/tensor.h"

namespace lather::LATHER_LEVEL {

/// What the law keeps per point.
template <class T>
struct HerschelBulkleyState {
  T volume_change;  ///< J - 1
  Sym3<T> strain;   ///< B = be - I, with det(I + B) = 1
};

/// Kirchhoff stress, Pa. [Foam eq. 2]
template <class T, class Real>
inline Sym3<T> kirchhoff_stress(const HerschelBulkleyState<T>& state,
                                const HerschelBulkleyConstants<Real>& c) {
  const T& j = state.volume_change;
  const T pressure_part = j * (j + Real(2)) * Real(Real(0.5) * c.bulk_modulus);  // kappa/2 (J^2 - 1)
  return add_isotropic(scale(deviator(state.strain), T(c.shear_modulus)), pressure_part);
}

/// I + B scaled to unit determinant, minus I.
template <class T>
inline Sym3<T> renormalize(const Sym3<T>& B) {
  using Real = typename ScalarOf<T>::type;
  const T d = det_minus_one(B);
  const T m = inverse_cube_root_of_one_plus(d);
  const T m_minus_one = -d / ((d + Real(1)) * (m * m + m + Real(1)));  // m^3 - 1 = -d / (1 + d)
  return add_isotropic(scale(B, m), m_minus_one);
}

/// det(I + A)^(-2/3) (I + A)(I + B)(I + A)^T - I with d = det(I + A) - 1. [Foam eq. 13]
template <class T>
inline Sym3<T> push_forward_isochoric(const Mat3<T>& A, const Sym3<T>& B, const T& d) {
  using Real = typename ScalarOf<T>::type;
  const T J_f = d + Real(1);
  const T m = inverse_cube_root_of_one_plus(d);
  const T c = m * m;                                                               // det(f)^(-2/3)
  const T c_minus_one = -d * (d + Real(2)) / (J_f * J_f * (c * c + c + Real(1)));  // c^3 - 1 = (1+d)^-2 - 1
  return add_isotropic(scale(push_forward_minus_identity(A, B), c), c_minus_one);
}

/// Elastic prediction over a step with incremental deformation f = I + A, A = dt grad v. [Foam eq. 12, 13]
template <class T>
inline HerschelBulkleyState<T> predict_elastic(const HerschelBulkleyState<T>& state, const Mat3<T>& A) {
  const T d = det_minus_one(A);
  const T& j = state.volume_change;
  return {j + d + j * d, push_forward_isochoric(A, state.strain, d)};
}

/// Stress beyond yield after the step: s - sqrt(2/3) sigma_Y, Pa, from the predicted one, both >= 0.
/// Solves s - s_pre = -2 mu~ dt ((s - y)/eta)^(1/h) [Foam eq. 15, 16] for x = (s - y)/(s_pre - y):
///
///   x + K x^(1/h) = 1,  ln K = ln(2 mu~ dt / e) + ln(e / eta)/h,  e = s_pre - y.
///
/// eta^(1/h) spans hundreds of decades, so the paper's bisection on (16) cannot know when to stop. Here the
/// larger of the two coefficients is scaled to 1 (x = K^-h w where K > 1), and where h > 1 the unknown is z
/// with x = z^h; both forms read L u + Q u^q = 1 with q = max(h, 1/h) >= 1 and max(L, Q) = 1. Its root lies
/// in [1/2, 1], that of f(t) = L e^t + Q e^(q t) - 1 in [-ln 2, 0]. Derivatives of f are sums of the same two
/// exponentials, none of which f(0) needs: Householder's method of fourth order from t = 0, with bisection to
/// guard it, takes two steps mostly, and one pair of exponentials. `two_mu_dt` is 2 mu~ dt in Pa s,
/// `excess_pre` = s_pre - sqrt(2/3) sigma_Y in Pa; lanes with excess_pre <= 0 give 0.
template <class T, class Real>
inline T plastic_excess(const T& excess_pre, const T& two_mu_dt, const HerschelBulkleyConstants<Real>& c) {
  const T zero(Real(0));
  const auto yields = excess_pre > zero;
  if (c.viscosity == Real(0)) return zero;  // perfect plasticity [Foam eq. 17]
  const T e = select(yields, excess_pre, T(c.viscosity));
  const T rate_ratio = two_mu_dt / e;
  if (c.flow_index == Real(1)) return select(yields, e / (two_mu_dt / T(c.viscosity) + Real(1)), zero);

  const T ln_e_eta = log(e / T(c.viscosity));
  const T ln_ratio = log(rate_ratio);
  const T ln_K = ln_ratio + ln_e_eta * c.inverse_flow_index;
  const T ln_root_scale = -ln_e_eta - ln_ratio * c.flow_index;  // ln K^-h
  const auto large_K = ln_K > zero;
  const T one(Real(1));
  const T scale_x =
      select(large_K, exp(min(ln_root_scale, zero)), one);  // x = scale_x * (the scaled unknown)
  const T coefficient_of_power = select(large_K, one, exp(min(ln_K, zero)));  // of x^(1/h), or w^(1/h)
  const bool thickens = c.flow_index > Real(1);
  const T L = thickens ? coefficient_of_power : scale_x;
  const T Q = thickens ? scale_x : coefficient_of_power;
  const Real q = thickens ? c.flow_index : c.inverse_flow_index;

  const Real close = sqrt(sqrt(c.epsilon));  // a step of this size over q leaves less than epsilon over q
  T lower(Real(-0.7));
  T upper = zero;
  T t = zero;
  T linear = L;  // L e^t
  T power = Q;   // Q e^(q t)
  for (int iteration = 0; iteration < 24; ++iteration) {
    const T f = (linear + power) - Real(1);
    const T f1 = linear + power * q;
    const T f2 = linear + power * (q * q);
    const T f3 = linear + power * (q * q * q);
    upper = select(f > zero, t, upper);
    lower = select(f > zero, lower, t);
    const T f1_squared = f1 * f1;
    const T better = t - f * (f1_squared * Real(6) - f * f2 * Real(3)) /
                             ((f1_squared - f * f2) * f1 * Real(6) + f * f * f3);
    const auto inside = (better >= lower) & (better <= upper);
    const T next = select(inside, better, (lower + upper) * Real(0.5));
    const T change = abs(next - t);
    t = next;
    if (!any(change * q > T(close))) break;
    linear = L * exp(t);
    power = Q * exp(t * q);
  }
  const T x = exp(thickens ? t * c.flow_index : t);
  return select(yields, x * scale_x * e, zero);
}

/// The same with constants of their own for each lane, one lane after the other.
template <class Real>
inline Lane<Real> plastic_excess(const Lane<Real>& excess_pre, const Lane<Real>& two_mu_dt,
                                 const HerschelBulkleyConstants<Lane<Real>>& c) {
  const Lane<Real>* values[] = {&excess_pre,     &two_mu_dt,   &c.bulk_modulus, &c.shear_modulus,
                                &c.yield_radius, &c.viscosity, &c.flow_index,   &c.inverse_flow_index,
                                &c.epsilon};
  Real lanes[std::size(values)][kLanes];
  for (std::size_t n = 0; n < std::size(values); ++n) values[n]->store(lanes[n]);
  Real excess[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const HerschelBulkleyConstants<Real> own = {lanes[2][k], lanes[3][k], lanes[4][k], lanes[5][k],
                                                lanes[6][k], lanes[7][k], lanes[8][k]};
    excess[k] = plastic_excess(lanes[0][k], lanes[1][k], own);
  }
  return Lane<Real>::load(excess);
}

/// Plastic correction after predict_elastic. [Foam eq. 14-18, Algorithm 13]
/// Returns the equivalent plastic strain of the step, sqrt(2/3) gamma dt.
template <class T, class C, class Real>
inline T correct_plastic(HerschelBulkleyState<T>& state, const HerschelBulkleyConstants<C>& c, Real dt) {
  const T trace_B = trace(state.strain);
  const Sym3<T> dev = deviator(state.strain);
  const T s_pre = sqrt(norm_squared(dev)) * c.shear_modulus;
  const T excess_pre = s_pre - T(c.yield_radius);
  const auto yields = excess_pre > T(Real(0));
  T plastic_strain(Real(0));
  if (any(yields)) {
    const T two_mu =
        (trace_B * Real(1.0 / 3.0) + Real(1)) * (c.shear_modulus * Real(2));  // 2 mu~, [Foam eq. 15]
    const T excess = plastic_excess(excess_pre, two_mu * dt, c);
    const T shrink = select(yields, (excess + c.yield_radius) / s_pre, T(Real(1)));
    state.strain = add_isotropic(scale(dev, shrink), trace_B * Real(1.0 / 3.0));  // [Foam eq. 18]
    plastic_strain =
        select(yields, (excess_pre - excess) / two_mu, plastic_strain) * Real(0.81649658092772603);
  }
  state.strain = renormalize(state.strain);
  return plastic_strain;
}

}  // namespace lather::LATHER_LEVEL
