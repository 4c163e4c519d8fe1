#pragma once

// Diffusion of concentrations between points [MLSRK section 4.2], in three sweeps over neighbours. Compiled
// per kernel level.
//
//   mu_c  = H'(c) - eps^2 lap c                                          [MLSRK eq. 16]
//   q_j   = m_j L~_j grad mu_c(x_j)
//   m_i c.  = -sum_j grad N_i(x_j) . q_j                                 [MLSRK eq. 13-15]
//
// sum_i grad N_i = 0, so that what one point gains others lose. Where some neighbours carry no concentration
// (or the constant is regularised) that sum, S_j over those that do, is not 0, and S_j . q_j goes back to j:
// nothing passes into them, and sum m c is kept to rounding everywhere.
//
// The Laplacian is 2 d [sum_j Phi V_j (c_j - c_i) - grad c . sum_j Phi V_j (x_j - x_i)] / sum_j Phi V_j
// r_ij^2. Within a lattice it is that of [MLSRK Appendix B] with the factor that fits the kernel; the second
// term keeps linear fields free of it at surfaces, where the denominator, unlike one of shape functions,
// stays above 0.

#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// Where the parts of a flux row lie: b, then per term of the basis sum_A q_A c_A, then q.
template <int Dim, class B>
struct FluxRow {
  static constexpr int kAlong = B::kCount;
  static constexpr int kFlux = 2 * B::kCount;
  static constexpr int kReals = kFlux + Dim;
};

/// Shape row of a lane's point, and what its neighbours' shape functions are there.
template <class T, int Dim, class B>
struct OwnShape {
  T b[B::kCount];
  T c[Dim][B::kCount];

  template <class Real>
  static OwnShape load(const Real* shape, int lane) {
    constexpr int N = B::kCount;
    constexpr int reals = N * (1 + Dim);
    OwnShape s;
    for (int k = 0; k < N; ++k) s.b[k] = Points<T>::load_row(shape, reals, k, lane);
    for (int a = 0; a < Dim; ++a)
      for (int k = 0; k < N; ++k) s.c[a][k] = Points<T>::load_row(shape, reals, N + a * N + k, lane);
    return s;
  }
  /// a d_A N_j over V_j.
  template <class W>
  void slopes(const Encounter<T, Dim, B, W>& e, T (&slope)[Dim]) const {
    const T corrected = dot(b, e.h);
    for (int a = 0; a < Dim; ++a) slope[a] = dot(c[a], e.h) * e.phi.value - corrected * e.phi.gradient[a];
  }
};

/// H'(c).
template <class T, class Real>
inline T chemical_potential(const T& c, const mlsrk::PhaseStep<Real>& step) {
  const T from_half = c - Real(0.5);
  if (!step.double_well) return from_half * Real(2);
  return c * (T(Real(1)) - c) * from_half * Real(-4);  // 2 c (1 - c) (1 - 2 c)
}

/// See PhaseKernels::crowding.
template <class T, class Real, int Dim, class B, class W>
void crowding(const mlsrk::Targets<Real>& targets, const mlsrk::Candidates<Real>& near, const Real* rest,
              Real* crowding) {
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    T sum(Real(0));
    for (std::int32_t j = 0; j < near.count; ++j) {
      const auto e = Encounter<T, Dim, B, W>::template at<1>(target, near.place + 4 * j);
      sum = sum + e.phi.value * rest[near.slot[j]];
    }
    Points<T>::store(sum, crowding, lane);
  }
}

/// See PhaseKernels::potentials.
template <class T, class Real, int Dim, class B, class W>
void potentials(const mlsrk::PhaseStep<Real>& step, const mlsrk::Targets<Real>& targets,
                const mlsrk::Candidates<Real>& near, const Real* own_shape, const Real* own_rows,
                const Real* rows, Real* potential) {
  using Row = mlsrk::PhaseRow;
  const T zero(Real(0));
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    const auto shape = OwnShape<T, Dim, B>::load(own_shape, lane);
    const T c = Points<T>::load_row(own_rows, Row::kReals, Row::kValue, lane);
    T difference = zero;  // sum Phi V (c_j - c)
    T spread = zero;      // sum Phi V xi^2
    T offset[Dim];        // sum Phi V xi
    T gradient[Dim];      // a grad c
    for (int a = 0; a < Dim; ++a) offset[a] = gradient[a] = zero;
    for (std::int32_t j = 0; j < near.count; ++j) {
      const Real* p = near.place + 4 * j;
      const Real* row = rows + std::size_t{near.slot[j]} * Row::kReals;
      const auto e = Encounter<T, Dim, B, W>::template at<1>(target, p);
      const Real volume = p[3] * row[Row::kMember];
      const T change = (T(row[Row::kValue]) - c) * volume;
      const T weight = e.phi.value * volume;
      T slope[Dim];
      shape.slopes(e, slope);
      difference = difference + e.phi.value * change;
      for (int a = 0; a < Dim; ++a) {
        const T xi = T(p[a]) - target.x[a];
        offset[a] = offset[a] + weight * xi;
        spread = spread + weight * xi * xi;
        gradient[a] = gradient[a] + slope[a] * change;
      }
    }
    for (int a = 0; a < Dim; ++a) difference = difference - gradient[a] * offset[a];
    const auto alone = spread <= zero;
    const T laplacian = difference * Real(2 * Dim) / select(alone, T(Real(1)), spread);  // a^2 lap c
    const T surface =
        laplacian * Real(step.squared_interface_width * step.inverse_scale * step.inverse_scale);
    Points<T>::store(chemical_potential(c, step) - select(alone, zero, surface), potential, lane);
  }
}

/// See PhaseKernels::fluxes.
template <class T, class Real, int Dim, class B, class W>
void fluxes(const mlsrk::PhaseStep<Real>& step, const mlsrk::Targets<Real>& targets,
            const mlsrk::Candidates<Real>& near, const Real* own_shape, const Real* own_rows,
            const Real* rows, Real* flux, Real* own) {
  using Row = mlsrk::PhaseRow;
  using Out = FluxRow<Dim, B>;
  constexpr int N = B::kCount;
  const T zero(Real(0));
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    const auto shape = OwnShape<T, Dim, B>::load(own_shape, lane);
    const T mu = Points<T>::load_row(own_rows, Row::kReals, Row::kValue, lane);
    const T mobility = Points<T>::load_row(own_rows, Row::kReals, Row::kMobility, lane);
    T gradient[Dim];  // a grad mu
    T leak[Dim];      // a S
    for (int a = 0; a < Dim; ++a) gradient[a] = leak[a] = zero;
    for (std::int32_t j = 0; j < near.count; ++j) {
      const Real* p = near.place + 4 * j;
      const Real* row = rows + std::size_t{near.slot[j]} * Row::kReals;
      const auto e = Encounter<T, Dim, B, W>::template at<1>(target, p);
      const Real volume = p[3] * row[Row::kMember];
      const T change = T(row[Row::kValue]) - mu;
      T slope[Dim];
      shape.slopes(e, slope);
      for (int a = 0; a < Dim; ++a) {
        const T s = slope[a] * volume;
        gradient[a] = gradient[a] + s * change;
        leak[a] = leak[a] + s;
      }
    }
    T q[Dim];
    T back = zero;
    for (int a = 0; a < Dim; ++a) {
      q[a] = gradient[a] * mobility * step.inverse_scale;
      back = back + leak[a] * q[a];
      Points<T>::store_row(q[a], flux, Out::kReals, Out::kFlux + a, lane);
    }
    Points<T>::store(back * step.inverse_scale, own, lane);
    for (int k = 0; k < N; ++k) {
      T along = q[0] * shape.c[0][k];
      for (int a = 1; a < Dim; ++a) along = along + q[a] * shape.c[a][k];
      Points<T>::store_row(shape.b[k], flux, Out::kReals, k, lane);
      Points<T>::store_row(along, flux, Out::kReals, Out::kAlong + k, lane);
    }
  }
}

/// See PhaseKernels::gains. N_i(x_j) is made with the corrections of j.
template <class T, class Real, int Dim, class B, class W>
void gains(const mlsrk::PhaseStep<Real>& step, const mlsrk::Targets<Real>& targets,
           const mlsrk::Candidates<Real>& near, const Real* flux, Real* gain, Real* volume) {
  using Row = FluxRow<Dim, B>;
  const T zero(Real(0));
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    T sum = zero;
    T lumped = zero;
    for (std::int32_t j = 0; j < near.count; ++j) {
      const Real* p = near.place + 4 * j;
      const auto e = Encounter<T, Dim, B, W>::template at<-1>(target, p);
      const Real* row = flux + std::size_t{near.slot[j]} * Row::kReals;
      const T corrected = dot(row, e.h);
      T from_c(row[Row::kAlong]);
      for (int k = 1; k < B::kCount; ++k) from_c = from_c + e.h[k] * row[Row::kAlong + k];
      T from_phi = e.phi.gradient[0] * row[Row::kFlux];
      for (int a = 1; a < Dim; ++a) from_phi = from_phi + e.phi.gradient[a] * row[Row::kFlux + a];
      sum = sum + (e.phi.value * from_c - corrected * from_phi);
      lumped = lumped + e.phi.value * corrected * p[3];
    }
    Points<T>::store(sum * target.volume * Real(-step.inverse_scale), gain, lane);
    Points<T>::store(lumped * target.volume, volume, lane);
  }
}

}  // namespace lather::LATHER_LEVEL
