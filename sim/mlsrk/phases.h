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

/// H'(c).
template <class T, class Real>
inline T chemical_potential(const T& c, const mlsrk::PhaseStep<Real>& step) {
  const T from_half = c - Real(0.5);
  if (!step.double_well) return from_half * Real(2);
  return c * (T(Real(1)) - c) * from_half * Real(-4);  // 2 c (1 - c) (1 - 2 c)
}

/// See PhaseKernels::crowding.
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void crowding(const mlsrk::Surroundings<Real>& around, const Real* rest, Real* crowding) {
  const Rows<Real> near = points_near<T, Dim, W, 1, false>(around, rest, 1);
  Rows<Real> neighbours = list_of(near, 0, 2 + Dim);
  for (int i = 0; i < around.count; ++i) {
    find_neighbours<T, Dim, W, 1>(around, near, i, neighbours);
    T weights(Real(0));
    for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>)
      weights =
          weights + Encounter<T, Dim, B, W>::at(neighbours, k).phi.value * load<T>(neighbours[Dim + 1] + k);
    crowding[i] = total(weights);
  }
}

/// See PhaseKernels::potentials.
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void potentials(const mlsrk::PhaseStep<Real>& step, const mlsrk::Surroundings<Real>& around,
                                 const Real* own_shape, const Real* rows, Real* potential) {
  using In = mlsrk::PhaseRows;
  const Rows<Real> near = points_near<T, Dim, W, 2, false>(around, rows, In::kCount);
  Rows<Real> neighbours = list_of(near, 0, 3 + Dim);
  const Real* own = rows + std::size_t{In::kCount} * kLanes * around.tile;
  for (int i = 0; i < around.count; ++i) {
    find_neighbours<T, Dim, W, 2>(around, near, i, neighbours);
    const ShapeRow<Real, Dim, B> shape = {own_shape + i * ShapeRow<Real, Dim, B>::kReals};
    const Real c = own[In::kValue * kLanes + i];
    T differences(Real(0));  // sum Phi V (c_j - c)
    T spreads(Real(0));      // sum Phi V xi^2
    T offsets[Dim];          // sum Phi V xi
    T gradients[Dim];        // a grad c
    for (int a = 0; a < Dim; ++a) offsets[a] = gradients[a] = T(Real(0));
    for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>) {
      const auto e = Encounter<T, Dim, B, W>::at(neighbours, k);
      const T volume = load<T>(neighbours[Dim] + k) * load<T>(neighbours[Dim + 1 + In::kMember] + k);
      const T change = (load<T>(neighbours[Dim + 1 + In::kValue] + k) - c) * volume;
      const T weight = e.phi.value * volume;
      T value;
      T slope[Dim];
      shape.functions(e, value, slope);
      differences = differences + e.phi.value * change;
      for (int a = 0; a < Dim; ++a) {
        const T xi = load<T>(neighbours[a] + k);
        offsets[a] = offsets[a] + weight * xi;
        spreads = spreads + weight * xi * xi;
        gradients[a] = gradients[a] + slope[a] * change;
      }
    }
    Real difference = total(differences);
    for (int a = 0; a < Dim; ++a) difference -= total(gradients[a]) * total(offsets[a]);
    const Real spread = total(spreads);
    const Real laplacian = spread > 0 ? difference * Real(2 * Dim) / spread : Real(0);  // a^2 lap c
    potential[i] = chemical_potential(c, step) -
                   laplacian * (step.squared_interface_width * step.inverse_scale * step.inverse_scale);
  }
}

/// See PhaseKernels::fluxes.
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void fluxes(const mlsrk::PhaseStep<Real>& step, const mlsrk::Surroundings<Real>& around,
                             const Real* own_shape, const Real* rows, Real* flux, Real* own) {
  using In = mlsrk::PhaseRows;
  using Out = FluxRow<Dim, B>;
  const Rows<Real> near = points_near<T, Dim, W, 2, false>(around, rows, In::kCount);
  Rows<Real> neighbours = list_of(near, 0, 3 + Dim);
  const Real* own_rows = rows + std::size_t{In::kCount} * kLanes * around.tile;
  for (int i = 0; i < around.count; ++i, flux += Out::kReals) {
    find_neighbours<T, Dim, W, 2>(around, near, i, neighbours);
    const ShapeRow<Real, Dim, B> shape = {own_shape + i * ShapeRow<Real, Dim, B>::kReals};
    const Real mu = own_rows[In::kValue * kLanes + i];
    T gradients[Dim];  // a grad mu
    T leaks[Dim];      // a S
    for (int a = 0; a < Dim; ++a) gradients[a] = leaks[a] = T(Real(0));
    for (std::int32_t k = 0; k < neighbours.count; k += kWidth<T>) {
      const T volume = load<T>(neighbours[Dim] + k) * load<T>(neighbours[Dim + 1 + In::kMember] + k);
      const T change = load<T>(neighbours[Dim + 1 + In::kValue] + k) - mu;
      T value;
      T slope[Dim];
      shape.functions(Encounter<T, Dim, B, W>::at(neighbours, k), value, slope);
      for (int a = 0; a < Dim; ++a) {
        const T s = slope[a] * volume;
        gradients[a] = gradients[a] + s * change;
        leaks[a] = leaks[a] + s;
      }
    }
    const Real mobility = own_rows[In::kMobility * kLanes + i] * step.inverse_scale;
    Real back = 0;
    for (int k = 0; k < B::kCount; ++k) flux[k] = shape.b()[k], flux[Out::kAlong + k] = Real(0);
    for (int a = 0; a < Dim; ++a) {
      const Real q = total(gradients[a]) * mobility;
      back += total(leaks[a]) * q;
      flux[Out::kFlux + a] = q;
      for (int k = 0; k < B::kCount; ++k) flux[Out::kAlong + k] += q * shape.c(a)[k];
    }
    own[i] = back * step.inverse_scale;
  }
}

/// See PhaseKernels::gains. N_i(x_j) is made with the corrections of j; lanes are the tile's points, as in
/// momentum().
template <class T, class Real, int Dim, class B, class W>
[[gnu::flatten]] void gains(const mlsrk::PhaseStep<Real>& step, const mlsrk::Surroundings<Real>& around,
                            const Real* flux, Real* gain, Real* volume) {
  using Row = FluxRow<Dim, B>;
  const Rows<Real> near = points_near<T, Dim, W, 0, true>(around);
  for (int lane = 0; lane < Points<T>::kPasses; ++lane) {
    const auto target = Target<T, Dim>::load(around, lane);
    T sum(Real(0));
    T lumped(Real(0));
    for (std::int32_t j = 0; j < near.count; ++j) {
      const auto e = Encounter<T, Dim, B, W>::from(near, j, target);
      const Real* row = flux + std::size_t{around.slots[j]} * Row::kReals;
      const T corrected = dot(row, e.h);
      T from_c(row[Row::kAlong]);
      for (int k = 1; k < B::kCount; ++k) from_c = from_c + e.h[k] * row[Row::kAlong + k];
      T from_phi = e.phi.gradient[0] * row[Row::kFlux];
      for (int a = 1; a < Dim; ++a) from_phi = from_phi + e.phi.gradient[a] * row[Row::kFlux + a];
      sum = sum + (e.phi.value * from_c - corrected * from_phi);
      lumped = lumped + e.phi.value * corrected * near[Dim][j];
    }
    Points<T>::store(sum * target.volume * Real(-step.inverse_scale), gain, lane);
    Points<T>::store(lumped * target.volume, volume, lane);
  }
}

}  // namespace lather::LATHER_LEVEL
