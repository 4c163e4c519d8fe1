#pragma once

/// Parameters of elastic and viscous parts that several laws share ("A Moving Least Square Reproducing Kernel
/// Particle Method", here [MLSRK]). SI units.
namespace lather {

struct ElasticParameters {
  double density = 0;         ///< rho, kg/m^3
  double youngs_modulus = 0;  ///< E, Pa
  double poisson_ratio = 0;   ///< nu, dimensionless, below 0.5

  /// Lamé's parameters, Pa. [MLSRK eq. 21]
  [[nodiscard]] double lame_mu() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  [[nodiscard]] double lame_lambda() const {
    return youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
  }
};

/// Newtonian viscosity beside the elastic stress. [MLSRK eq. 23]
struct ViscousParameters {
  double viscosity = 0;       ///< mu_v, against change of form, Pa s
  double bulk_viscosity = 0;  ///< zeta_v, against change of volume, Pa s

  [[nodiscard]] bool any() const { return viscosity > 0 || bulk_viscosity > 0; }
};

}  // namespace lather
