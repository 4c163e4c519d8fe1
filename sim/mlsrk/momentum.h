#pragma once

// Forces between points, and the velocities they make. Compiled per kernel level.

#include "sim/mlsrk/neighbour.h"

namespace lather::LATHER_LEVEL {

/// Where the parts of a force row lie: b, then per term of the basis a vector (sum_B V sigma_AB c_B), then
/// V sigma as xx yy xy (2D) or xx yy zz xy xz yz, then the mass.
template <int Dim, class B>
struct ForceRow {
  static constexpr int kStress = Dim == 3 ? 6 : 3;
  static constexpr int kVectors = B::kCount;
  static constexpr int kStressAt = kVectors + B::kCount * Dim;
  static constexpr int kMass = kStressAt + kStress;
  static constexpr int kReals = kMass + 1;

  /// Index within V sigma of the component (a, b).
  static constexpr int component(int a, int b) { return a == b ? a : Dim == 2 ? 2 : 2 + a + b; }
};

/// [stress], its second half: what neighbours read of a point in momentum().
template <class Real, int Dim, class B>
void prepare_forces(const Real* shape, const Real* stress, Real* force) {
  using Row = ForceRow<Dim, B>;
  constexpr int N = B::kCount;
  for (int i = 0; i < kLanes;
       ++i, shape += N * (1 + Dim), stress += mlsrk::kStressReals, force += Row::kReals) {
    for (int k = 0; k < N; ++k) force[k] = shape[k];
    Real* S = force + Row::kStressAt;
    if constexpr (Dim == 3)
      for (int k = 0; k < 6; ++k) S[k] = stress[k];
    else
      S[0] = stress[0], S[1] = stress[1], S[2] = stress[3];
    for (int k = 0; k < N; ++k)
      for (int a = 0; a < Dim; ++a) {
        Real sum = 0;
        for (int b = 0; b < Dim; ++b) sum += S[Row::component(a, b)] * shape[N + b * N + k];
        force[Row::kVectors + k * Dim + a] = sum;
      }
    force[Row::kMass] = stress[7];
  }
}

/// [momentum] u_i += dt (f_i / m + g), with f_i = -sum_j grad N_i(x_j) . sigma_j V_j and the lumped mass
/// m = sum_j N_i(x_j) m_j [MLSRK eq. 11]. N_i(x_j) is made with the corrections of j.
template <class T, class Real, int Dim, class B, class W>
void momentum(const mlsrk::MomentumStep<Real>& step, const mlsrk::Targets<Real>& targets,
              const mlsrk::Candidates<Real>& near, const Real* force, Real* velocity, Real* lumped_mass) {
  using Row = ForceRow<Dim, B>;
  const T zero(Real(0));
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(targets, lane);
    T sum[Dim];
    for (T& s : sum) s = zero;
    T lumped = zero;
    for (std::int32_t j = 0; j < near.count; ++j) {
      const auto e = Encounter<T, Dim, B, W>::template at<-1>(target, near.place + 4 * j);
      const Real* row = force + std::size_t{near.slot[j]} * Row::kReals;
      const T corrected = dot(row, e.h);
      for (int a = 0; a < Dim; ++a) {
        T from_c(row[Row::kVectors + a]);
        for (int k = 1; k < B::kCount; ++k) from_c = from_c + e.h[k] * row[Row::kVectors + k * Dim + a];
        T from_phi = e.phi.gradient[0] * row[Row::kStressAt + Row::component(a, 0)];
        for (int b = 1; b < Dim; ++b)
          from_phi = from_phi + e.phi.gradient[b] * row[Row::kStressAt + Row::component(a, b)];
        sum[a] = sum[a] + (e.phi.value * from_c - corrected * from_phi);
      }
      lumped = lumped + e.phi.value * corrected * row[Row::kMass];
    }
    lumped = lumped * target.volume;
    const T own = Points<T>::load_row(velocity, mlsrk::kVelocityReals, 3, lane);
    Points<T>::store(lumped, lumped_mass, lane);
    const T mass = step.own_mass ? own : select(lumped >= own * Real(mlsrk::kLightest), lumped, own);
    const T per_mass = target.volume * Real(-step.dt * step.inverse_scale) / mass;
    for (int a = 0; a < Dim; ++a) {
      const T u = Points<T>::load_row(velocity, mlsrk::kVelocityReals, a, lane);
      Points<T>::store_row(u + (sum[a] * per_mass + Real(step.dt * step.gravity[a])), velocity,
                           mlsrk::kVelocityReals, a, lane);
    }
  }
}

}  // namespace lather::LATHER_LEVEL
