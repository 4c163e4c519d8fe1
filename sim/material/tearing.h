#pragma once

// Tearing and recovery of foam [Foam section 7], on lanes of material points or on one point. Compiled per
// kernel level.
//
//   C^p = J^(-2/3) F^T be^-1 F                                           [Foam section 7.1, Algorithm 7]
//   weak = |dev C^p|_F > sigma_T
//
// The deformation gradient is held as G = F - I. A plain float F loses every increment below 3e-8, which a
// flow of 1e-3/s makes in a step of 1e-5 s; at rest, and while strains are small, G keeps their digits. J is
// the state's own: F agrees with it to rounding, and det F loses its digits in a large shear before J does.

#include "sim/material/herschel_bulkley.h"
#include "sim/math/eigen.h"

namespace lather::LATHER_LEVEL {

/// F <- f F as differences from I, f = I + A. The whole increment is rounded once, to a varying bit: were A
/// added on its own, a steady A would be rounded the same way in every step.
template <class T>
inline Mat3<T> deformed(const Mat3<T>& G, const Mat3<T>& A) {
  return sum(G, sum(A, product(A, G)));
}

/// C^p - I from G = F - I.
template <class T>
inline Sym3<T> plastic_strain_tensor(const HerschelBulkleyState<T>& state, const Mat3<T>& G) {
  const Sym3<T> inverse = unimodular_inverse_minus_identity(state.strain);
  return push_forward_isochoric(transpose(G), inverse, state.volume_change);
}

/// |dev C^p|_F, dimensionless. [Foam Algorithm 7]
template <class T>
inline T accumulated_plasticity(const HerschelBulkleyState<T>& state, const Mat3<T>& G) {
  return sqrt(norm_squared(deviator(plastic_strain_tensor(state, G))));
}

/// The stress without its tensile part: eigenvalues min(0, tau_i). [Foam section 7.2, Algorithm 8]
template <class T>
inline Sym3<T> limited_stress(const Sym3<T>& tau) {
  Eigenpairs<T> e = eigenpairs(tau);
  for (T& value : e.value) value = min(value, T(0));
  return assemble(e.value, e.vector);
}

/// Increment f_corr - I of a weak point from f - I = A: no shear that stretches it further, and no expansion
/// of what is expanded already (J_n > 1 and J_f > 1). [Foam section 7.2, Algorithm 11]
template <class T>
inline Mat3<T> limited_increment(const HerschelBulkleyState<T>& state, const Mat3<T>& A) {
  using Real = typename ScalarOf<T>::type;
  const T zero(Real(0));
  const T d = det_minus_one(A);  // J_f - 1
  // J_f^(1/3) and J_f^(-1/3), minus 1.
  const T grow = expm1(log1p(d) * Real(1.0 / 3.0));
  const T shrink = -grow / (grow + Real(1));
  const Mat3<T> isochoric = add_isotropic(scale(A, shrink + Real(1)), shrink);

  const auto accumulates =
      largest_eigenvalue(predict_elastic(state, A).strain) > largest_eigenvalue(state.strain);
  Mat3<T> rotation = isochoric;
  if (any(accumulates)) rotation = select(accumulates, polar_rotation_minus_identity(isochoric), isochoric);
  const auto expands = (state.volume_change > zero) & (d > zero);
  const Mat3<T> with_volume = select(accumulates, add_isotropic(scale(rotation, grow + Real(1)), grow), A);
  return select(expands, rotation, with_volume);
}

/// F <- F U S^exponent U^T with C^p = U S U^T and exponent = (exp(-t/eta_p) - 1)/2, as differences from I:
/// the plastic stretches fade as lambda^exp(-t/eta_p). [Foam section 7.3, Algorithm 14]
template <class T>
inline Mat3<T> recovered(const HerschelBulkleyState<T>& state, const Mat3<T>& G, const T& exponent) {
  using Real = typename ScalarOf<T>::type;
  const T one(Real(1));
  Eigenpairs<T> e = eigenpairs(plastic_strain_tensor(state, G));
  // An eigenvalue is known to a rounding of the largest one only.
  const T largest = max(e.value[0], max(e.value[1], e.value[2])) + Real(1);
  const T least = largest * Real(4 * std::numeric_limits<Real>::epsilon());
  T log_S[3];
  T uncertainty[3];
  for (int k = 0; k < 3; ++k) {
    const T S_minus_one = max(e.value[k], least - Real(1));
    log_S[k] = log1p(S_minus_one);
    uncertainty[k] = one / (S_minus_one + Real(1));
  }
  // det C^p = 1, so the logarithms sum to 0; what they miss goes to the least certain. So det(R) = 1 as well.
  const T excess = (log_S[0] + log_S[1] + log_S[2]) / (uncertainty[0] + uncertainty[1] + uncertainty[2]);
  for (int k = 0; k < 3; ++k)
    e.value[k] = expm1((log_S[k] - excess * uncertainty[k]) * exponent);  // of R - I
  const Mat3<T> R = full(assemble(e.value, e.vector));
  return sum(G, sum(R, product(G, R)));
}

}  // namespace lather::LATHER_LEVEL
