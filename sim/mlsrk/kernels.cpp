// Compiled once per kernel level and precision: LATHER_LEVEL (v2, v3, v4) names the namespace, LATHER_REAL
// the type, LATHER_TABLE the function that hands the table out.

#include "sim/mlsrk/kernels.h"

#include "sim/mlsrk/gradients.h"
#include "sim/mlsrk/laws.h"
#include "sim/mlsrk/momentum.h"
#include "sim/mlsrk/phases.h"
#include "sim/mlsrk/positions.h"
#include "sim/mlsrk/shape_functions.h"

namespace lather::LATHER_LEVEL {
namespace {

template <class T, class Real, int Dim, int Order, class W>
mlsrk::Kernels<Real> kernels() {
  using B = Basis<Order, Dim>;
  return {ShapeRow<Real, Dim, B>::kReals, shape_functions<T, Real, Dim, B, W>, momentum<T, Real, Dim, B, W>,
          gradients<T, Real, Dim, B, W>};
}

template <class T, class Real, int Dim, int Order, class W>
mlsrk::PhaseKernels<Real> phase_kernels() {
  using B = Basis<Order, Dim>;
  return {FluxRow<Dim, B>::kReals, crowding<T, Real, Dim, B, W>, potentials<T, Real, Dim, B, W>,
          fluxes<T, Real, Dim, B, W>, gains<T, Real, Dim, B, W>};
}

template <class T, class Real, int Dim, int Order, class W>
void fill_one(mlsrk::Kernels<Real>& k, mlsrk::PhaseKernels<Real>& p) {
  k = kernels<T, Real, Dim, Order, W>();
  p = phase_kernels<T, Real, Dim, Order, W>();
}

template <class T, class Real, int Dim>
void fill(mlsrk::Kernels<Real> (&table)[3][2], mlsrk::PhaseKernels<Real> (&phases)[3][2]) {
  fill_one<T, Real, Dim, 0, TensorWeight>(table[0][0], phases[0][0]);
  fill_one<T, Real, Dim, 0, RadialWeight>(table[0][1], phases[0][1]);
  fill_one<T, Real, Dim, 1, TensorWeight>(table[1][0], phases[1][0]);
  fill_one<T, Real, Dim, 1, RadialWeight>(table[1][1], phases[1][1]);
  fill_one<T, Real, Dim, 2, TensorWeight>(table[2][0], phases[2][0]);
  fill_one<T, Real, Dim, 2, RadialWeight>(table[2][1], phases[2][1]);
}

template <class Real>
mlsrk::KernelTable<Real> make_table() {
  mlsrk::KernelTable<Real> table;
  fill_laws<Real, 2, Real>(table.laws[0][0]);
  fill_laws<Real, 2, Lane<Real>>(table.laws[0][1]);
  fill_laws<Real, 3, Real>(table.laws[1][0]);
  fill_laws<Real, 3, Lane<Real>>(table.laws[1][1]);
  table.positions[0] = positions<Real, 2>;
  table.positions[1] = positions<Real, 3>;
  fill<Lane<Real>, Real, 2>(table.wide[0], table.phases[0]);
  fill<Lane<Real>, Real, 3>(table.wide[1], table.phases[1]);
  fill<Real, Real, 2>(table.scalar[0], table.scalar_phases[0]);
  fill<Real, Real, 3>(table.scalar[1], table.scalar_phases[1]);
  return table;
}

}  // namespace
}  // namespace lather::LATHER_LEVEL

namespace lather::mlsrk {

const KernelTable<LATHER_REAL>& LATHER_TABLE();
const KernelTable<LATHER_REAL>& LATHER_TABLE() {
  static const KernelTable<LATHER_REAL> table = LATHER_LEVEL::make_table<LATHER_REAL>();
  return table;
}

}  // namespace lather::mlsrk
