// Compiled once per kernel level and precision: LATHER_LEVEL (v2, v3, v4) names the namespace, LATHER_REAL
// the type, LATHER_TABLE the function that hands the table out.

#include "sim/material/law_points.h"

#include "sim/material/drucker_prager.h"
#include "sim/material/equation_of_state.h"
#include "sim/material/neo_hookean.h"
#include "sim/material/newtonian.h"
#include "sim/material/snow.h"
#include "sim/material/volume_correction.h"

namespace lather::LATHER_LEVEL {
namespace {

template <class T>
inline constexpr int kPointsIn = 1;
template <class Real>
inline constexpr int kPointsIn<Lane<Real>> = kLanes;

/// Arrays of points as values of T: from `first` on, as many as T is wide.
template <class T, class Real>
struct Batch {
  static constexpr int kWidth = kPointsIn<T>;
  int first;
  int count;  ///< of these points; lanes beyond repeat the first one

  T in(const Real* from, int stride, int component) const {
    const auto at = [&](int k) {
      return from[static_cast<std::ptrdiff_t>(first + (k < count ? k : 0)) * stride + component];
    };
    if constexpr (kWidth == 1) {
      return at(0);
    } else {
      Real values[kWidth];
      for (int k = 0; k < kWidth; ++k) values[k] = at(k);
      return T::load(values);
    }
  }
  void out(const T& value, Real* to, int stride, int component) const {
    Real values[kWidth];
    if constexpr (kWidth == 1)
      values[0] = value;
    else
      value.store(values);
    for (int k = 0; k < count; ++k)
      to[static_cast<std::ptrdiff_t>(first + k) * stride + component] = values[k];
  }

  Mat3<T> matrix(const Real* from) const {
    Mat3<T> m;
    for (int i = 0; i < 9; ++i) m.m[i / 3][i % 3] = in(from, 9, i);
    return m;
  }
  void put(const Mat3<T>& m, Real* to) const {
    for (int i = 0; i < 9; ++i) out(m.m[i / 3][i % 3], to, 9, i);
  }
  void put(const Sym3<T>& s, Real* to) const {
    const T* entries[6] = {&s.xx, &s.yy, &s.zz, &s.xy, &s.xz, &s.yz};
    for (int i = 0; i < 6; ++i) out(*entries[i], to, 6, i);
  }
};

template <class T, class Real>
struct LawsAtPoints {
  using Points = Batch<T, Real>;

  template <class Work>
  static void for_batches(int n, const Work& work) {
    for (int first = 0; first < n; first += Points::kWidth)
      work(Points{first, n - first < Points::kWidth ? n - first : Points::kWidth});
  }
  /// Calls work with the dimension as a type.
  template <class Work>
  static void with_dimension(int dimension, const Work& work) {
    if (dimension == 2)
      work(std::integral_constant<int, 2>());
    else
      work(std::integral_constant<int, 3>());
  }

  static void principal(const Real* G, int n, Real* log, Real* right) {
    for_batches(n, [&](const Points& p) {
      const Stretches<T> s = stretches(p.matrix(G));
      for (int k = 0; k < 3; ++k) {
        p.out(s.log[k], log, 3, k);
        for (int i = 0; i < 3; ++i) p.out(s.right[k][i], right, 9, 3 * k + i);
      }
    });
  }
  static void solid_stress(const NeoHookeanConstants<Real>& c, const Real* G, int n, Real* tau) {
    for_batches(n, [&](const Points& p) { p.put(kirchhoff_stress(p.matrix(G), c), tau); });
  }
  static void solid_energy(const NeoHookeanConstants<Real>& c, const Real* G, int n, Real* energy) {
    for_batches(n, [&](const Points& p) { p.out(energy_density(p.matrix(G), c), energy, 1, 0); });
  }
  static void viscosity(const NewtonianConstants<Real>& c, int dimension, const Real* L, int n, Real* sigma) {
    with_dimension(dimension, [&](auto dim) {
      for_batches(n, [&](const Points& p) { p.put(viscous_stress<dim.value>(p.matrix(L), c), sigma); });
    });
  }
  static void liquid_pressure(const EquationOfStateConstants<Real>& c, const Real* volume_change, int n,
                              Real* to) {
    for_batches(n, [&](const Points& p) { p.out(pressure(p.in(volume_change, 1, 0), c), to, 1, 0); });
  }
  static void liquid_energy(const EquationOfStateConstants<Real>& c, const Real* volume_change, int n,
                            Real* energy) {
    for_batches(n,
                [&](const Points& p) { p.out(energy_density(p.in(volume_change, 1, 0), c), energy, 1, 0); });
  }
  static void hardened(Real xi, const Real* plastic_volume, int n, Real* factor) {
    for_batches(n, [&](const Points& p) { p.out(hardening(p.in(plastic_volume, 1, 0), xi), factor, 1, 0); });
  }
  template <class Constants>
  static void yield(const Constants& c, int dimension, int n, Real* G, Real* plastic_volume) {
    with_dimension(dimension, [&](auto dim) {
      for_batches(n, [&](const Points& p) {
        ElastoplasticState<T> state = {p.matrix(G), p.in(plastic_volume, 1, 0)};
        correct_plastic<dim.value>(state, c);
        p.put(state.deformation, G);
        p.out(state.plastic_volume, plastic_volume, 1, 0);
      });
    });
  }
  static void correct_volume(int dimension, const Real* volume_change, const Real* plastic_volume, int n,
                             Real* G) {
    with_dimension(dimension, [&](auto dim) {
      for_batches(n, [&](const Points& p) {
        p.put(volume_corrected<dim.value>(p.matrix(G), p.in(volume_change, 1, 0), p.in(plastic_volume, 1, 0)),
              G);
      });
    });
  }

  static LawPointKernels<Real> kernels() {
    return {principal,
            solid_stress,
            solid_energy,
            viscosity,
            liquid_pressure,
            liquid_energy,
            hardened,
            yield<SnowConstants<Real>>,
            yield<DruckerPragerConstants<Real>>,
            correct_volume};
  }
};

}  // namespace
}  // namespace lather::LATHER_LEVEL

namespace lather {

const LawPointTable<LATHER_REAL>& LATHER_TABLE();
const LawPointTable<LATHER_REAL>& LATHER_TABLE() {
  using LATHER_LEVEL::Lane;
  using LATHER_LEVEL::LawsAtPoints;
  static const LawPointTable<LATHER_REAL> table = {LawsAtPoints<LATHER_REAL, LATHER_REAL>::kernels(),
                                                   LawsAtPoints<Lane<LATHER_REAL>, LATHER_REAL>::kernels()};
  return table;
}

}  // namespace lather
