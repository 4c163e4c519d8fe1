// Compiled once per kernel level and precision: LATHER_LEVEL (v2, v3, v4) names the namespace, LATHER_REAL
// the type, LATHER_TABLE the function that hands the table out.

#include "sim/mpm/kernels.h"

#include "sim/mpm/advance.h"
#include "sim/mpm/gather.h"
#include "sim/mpm/grid_kernels.h"
#include "sim/mpm/laws.h"
#include "sim/mpm/resample/nearest.h"
#include "sim/mpm/stiffness.h"
#include "sim/mpm/tearing_points.h"

namespace lather::LATHER_LEVEL {
namespace {

template <class Real, int Dim, bool Cubic, bool Apic>
mpm::Kernels<Real> kernels() {
  return {detect_tearing<Real, Dim>,  scatter<Real, Dim, Cubic, Apic>,
          reduce<Real, Dim>,          update_grid<Real, Dim, Apic>,
          collect<Real, Dim>,         gather<Real, Dim, Cubic, Apic>,
          recover<Real, Dim>,         advance<Real, Dim>,
          stiffness<Real, Dim, Cubic>};
}

template <class Real>
void plastic_excess_wide(const HerschelBulkleyConstants<Real>& c, const Real* excess_pre,
                         const Real* two_mu_dt, int n, Real* excess) {
  for (int first = 0; first < n; first += kLanes) {
    Real e[kLanes] = {};
    Real m[kLanes] = {};
    const int count = n - first < kLanes ? n - first : kLanes;
    for (int k = 0; k < kLanes; ++k) {
      e[k] = excess_pre[first + (k < count ? k : 0)];
      m[k] = two_mu_dt[first + (k < count ? k : 0)];
    }
    plastic_excess(Lane<Real>::load(e), Lane<Real>::load(m), c).store(e);
    for (int k = 0; k < count; ++k) excess[first + k] = e[k];
  }
}

template <class Real>
void plastic_excess_scalar(const HerschelBulkleyConstants<Real>& c, const Real* excess_pre,
                           const Real* two_mu_dt, int n, Real* excess) {
  for (int k = 0; k < n; ++k) excess[k] = plastic_excess(excess_pre[k], two_mu_dt[k], c);
}

template <class T, class Real>
HerschelBulkleyState<T> as_state(const Real* s) {
  return {T(s[0]), {T(s[1]), T(s[2]), T(s[3]), T(s[4]), T(s[5]), T(s[6])}};
}

template <class T, class Real>
Mat3<T> as_matrix(const Real* a) {
  Mat3<T> A;
  for (int i = 0; i < 9; ++i) A.m[i / 3][i % 3] = T(a[i]);
  return A;
}

template <class Real>
Real law_step(const HerschelBulkleyConstants<Real>& c, const Real* a, Real dt, Real* state) {
  HerschelBulkleyState<Real> s = predict_elastic(as_state<Real>(state), as_matrix<Real>(a));
  const Real strain = correct_plastic(s, c, dt);
  const Sym3<Real>& b = s.strain;
  const Real out[7] = {s.volume_change, b.xx, b.yy, b.zz, b.xy, b.xz, b.yz};
  for (int i = 0; i < 7; ++i) state[i] = out[i];
  return strain;
}

template <class Real>
Real law_step_wide(const HerschelBulkleyConstants<Real>& c, const Real* a, Real dt, Real* state, int lane) {
  HerschelBulkleyState<Lane<Real>> s = predict_elastic(as_state<Lane<Real>>(state), as_matrix<Lane<Real>>(a));
  const Lane<Real> strain = correct_plastic(s, c, dt);
  const Sym3<Lane<Real>>& b = s.strain;
  const Lane<Real>* out[7] = {&s.volume_change, &b.xx, &b.yy, &b.zz, &b.xy, &b.xz, &b.yz};
  Real values[kLanes];
  for (int i = 0; i < 7; ++i) {
    out[i]->store(values);
    state[i] = values[lane];
  }
  strain.store(values);
  return values[lane];
}

template <class Real>
void stress(const HerschelBulkleyConstants<Real>& c, const Real* state, Real* tau) {
  const Sym3<Real> t = kirchhoff_stress(as_state<Real>(state), c);
  const Real out[6] = {t.xx, t.yy, t.zz, t.xy, t.xz, t.yz};
  for (int i = 0; i < 6; ++i) tau[i] = out[i];
}

template <class Real>
int weights(bool cubic, Real fraction, Real* weight, Real* derivative) {
  const bool upper = fraction >= Real(0.5);
  const Weights1<Real> w =
      cubic ? cubic_weights(fraction) : quadratic_weights(upper ? fraction - Real(1) : fraction);
  for (int n = 0; n < 4; ++n) {
    weight[n] = w.w[n];
    derivative[n] = w.d[n];
  }
  return cubic || !upper ? -1 : 0;
}

template <class Real>
mpm::KernelTable<Real> make_table() {
  mpm::KernelTable<Real> table = {
      {{{kernels<Real, 2, false, false>(), kernels<Real, 2, false, true>()},
        {kernels<Real, 2, true, false>(), kernels<Real, 2, true, true>()}},
       {{kernels<Real, 3, false, false>(), kernels<Real, 3, false, true>()},
        {kernels<Real, 3, true, false>(), kernels<Real, 3, true, true>()}}},
      {},
      {plastic_excess_wide<Real>, plastic_excess_scalar<Real>, law_step<Real>, law_step_wide<Real>,
       stress<Real>, weights<Real>, tearing_kernels<Real, Real>(), tearing_kernels<Lane<Real>, Real>()},
      nearest};
  fill_laws<Real, 2>(table.laws[0]);
  fill_laws<Real, 3>(table.laws[1]);
  return table;
}

}  // namespace
}  // namespace lather::LATHER_LEVEL

namespace lather::mpm {

const KernelTable<LATHER_REAL>& LATHER_TABLE();
const KernelTable<LATHER_REAL>& LATHER_TABLE() {
  static const KernelTable<LATHER_REAL> table = LATHER_LEVEL::make_table<LATHER_REAL>();
  return table;
}

}  // namespace lather::mpm
