#pragma once

#include "sim/kernel_level.h"
#include "sim/material/drucker_prager_constants.h"
#include "sim/material/equation_of_state_constants.h"
#include "sim/material/neo_hookean_constants.h"
#include "sim/material/newtonian_constants.h"
#include "sim/material/snow_constants.h"

/// The laws that MLSRK brings at single points, for tests: a border of plain structs and pointers to
/// kernels that are compiled once per instruction set.
namespace lather {

/// Each works on n points, one after the other in the arrays. Tensors are row by row, symmetric ones
/// xx yy zz xy xz yz; G = F - I or F_e - I, `plastic_volume` = J_p - 1, `volume_change` = J - 1 or V/V0 - 1.
/// In 2 dimensions the z parts of G and of a velocity gradient are 0.
template <class Real>
struct LawPointKernels {
  /// Logarithms of the stretches (3 a point, in no order) and their right vectors (3 rows of 3).
  void (*stretches)(const Real* G, int n, Real* log, Real* right);
  /// Kirchhoff stress, Pa.
  void (*neo_hookean_stress)(const NeoHookeanConstants<Real>&, const Real* G, int n, Real* tau);
  /// Energy per volume at rest, Pa.
  void (*neo_hookean_energy)(const NeoHookeanConstants<Real>&, const Real* G, int n, Real* energy);
  /// Cauchy stress, Pa, of velocity gradients in 1/s.
  void (*viscous_stress)(const NewtonianConstants<Real>&, int dimension, const Real* velocity_gradient, int n,
                         Real* sigma);
  /// Pressure, Pa.
  void (*liquid_pressure)(const EquationOfStateConstants<Real>&, const Real* volume_change, int n,
                          Real* pressure);
  /// Energy per volume at rest, Pa.
  void (*liquid_energy)(const EquationOfStateConstants<Real>&, const Real* volume_change, int n,
                        Real* energy);
  /// Factor on Lamé's parameters.
  void (*hardening)(Real xi, const Real* plastic_volume, int n, Real* factor);
  /// Plastic corrections in place.
  void (*snow)(const SnowConstants<Real>&, int dimension, int n, Real* G, Real* plastic_volume);
  void (*drucker_prager)(const DruckerPragerConstants<Real>&, int dimension, int n, Real* G,
                         Real* plastic_volume);
  /// Correction of volumes in place.
  void (*correct_volume)(int dimension, const Real* volume_change, const Real* plastic_volume, int n,
                         Real* G);
};

/// The same kernels one point at a time and, as in a run, on lanes of 16.
template <class Real>
struct LawPointTable {
  LawPointKernels<Real> scalar;
  LawPointKernels<Real> wide;
};

/// The laws of a level, which the machine must have (machine_has); Real is float or double.
template <class Real>
[[nodiscard]] const LawPointTable<Real>& law_point_kernels(KernelLevel level);

}  // namespace lather
