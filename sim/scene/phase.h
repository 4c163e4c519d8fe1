#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Materials whose points carry a concentration that diffuses ("A Moving Least Square Reproducing Kernel
/// Particle Method", here [MLSRK], section 4.2).
namespace lather {

/// From `start` to `end` between two concentrations, with level ends: u^2 (3 - 2 u).
struct Smoothstep {
  double from = 0;   ///< concentration up to which the value is `start`
  double to = 1;     ///< concentration from which on it is `end`
  double start = 0;  ///< in the unit of the parameter
  double end = 0;
};

/// Straight lines between points, the outermost values beyond them.
struct CurvePoint {
  double concentration = 0;
  double value = 0;
};
struct CurveTable {
  std::vector<CurvePoint> points;  ///< by ascending concentration, at least one
};

/// sum_k coefficients[k] c^k.
struct CurvePolynomial {
  std::vector<double> coefficients;
};

/// A parameter as a function of the concentration.
using Curve = std::variant<Smoothstep, CurveTable, CurvePolynomial>;

/// The curve's value at a concentration, which is taken as 0 below 0 and 1 above 1.
[[nodiscard]] double value_at(const Curve& curve, double concentration);

/// Laws that change with the concentration are tabulated in this many equal steps from 0 to 1.
inline constexpr int kConcentrationNodes = 256;

/// What a material that takes part in diffusion has beside its law.
struct Phase {
  double concentration = 0;  ///< c at t = 0: the mass of the component that is followed over all mass, 0 … 1
  double mobility = 0;       ///< L~, m^2/s
  std::vector<std::pair<std::string, Curve>> by_concentration;  ///< by the key of the law's parameter

  /// The curve of the law's parameter `key`; null where it does not change.
  [[nodiscard]] const Curve* curve_of(const std::string& key) const;
};

/// Which equation moves the concentration.
enum class PhaseBalance {
  kMass,           ///< [MLSRK eq. 15] per own mass: keeps sum m c
  kLumpedMass,     ///< [MLSRK eq. 15] as printed: keeps sum rho V~ c while points rest
  kConcentration,  ///< eta = c, as Yang et al. (2015): keeps sum V~ c while points rest
};

/// Free energy H(c), dimensionless.
enum class FreeEnergy {
  kDiffusion,   ///< (c - 1/2)^2: all mixes
  kDoubleWell,  ///< c^2 (1 - c)^2: parts into c = 0 and c = 1
};

/// How concentrations are computed.
struct PhaseNumerics {
  std::optional<double> interface_width;  ///< epsilon, m; none: the kernel's scale a
  PhaseBalance balance = PhaseBalance::kMass;
  FreeEnergy free_energy = FreeEnergy::kDiffusion;
};

}  // namespace lather
