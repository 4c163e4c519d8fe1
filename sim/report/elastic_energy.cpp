#include "sim/report/elastic_energy.h"

#include <cmath>

#include "sim/math/determinant.h"

namespace lather {
namespace {

/// [MLSRK eq. 20] from G = F_e - I without cancellation: F F^T - I = G + G^T + G G^T.
ElasticEnergy neo_hookean_energy(const ElasticParameters& p, double hardened, const Mat3& G) {
  const double log_J = std::log1p(determinant_change(G));
  const double trace = 2 * G.trace() + G.squaredNorm();
  return {hardened * p.lame_lambda() / 2 * log_J * log_J, hardened * p.lame_mu() * (trace / 2 - log_J)};
}

struct EnergyOf {
  const ElasticState& s;

  /// (J^2 - 1)/2 - ln J with j = J - 1, without cancellation: j + j^2/2 - log1p(j).
  ElasticEnergy operator()(const HerschelBulkleyParameters& p) const {
    const double j = s.volume_change;
    return {0.5 * p.bulk_modulus * (j + 0.5 * j * j - std::log1p(j)),
            0.5 * p.shear_modulus * s.trace_elastic_strain};
  }
  ElasticEnergy operator()(const NeoHookeanParameters& p) const {
    return neo_hookean_energy(p.elastic, 1, s.deformation);
  }
  ElasticEnergy operator()(const DruckerPragerParameters& p) const {
    return neo_hookean_energy(p.elastic, hardened(p.hardening), s.deformation);
  }
  ElasticEnergy operator()(const SnowParameters& p) const {
    return neo_hookean_energy(p.elastic, hardened(p.hardening), s.deformation);
  }
  /// The integral of p = (K/gamma) (J^-gamma - 1) from J to 1.
  ElasticEnergy operator()(const LiquidParameters& p) const {
    const double j = s.volume_change;
    if (j >= 0) return {};
    const double power = 1 - p.exponent;
    const double log_J = std::log1p(j);
    const double integral = power == 0 ? log_J : std::expm1(power * log_J) / power;
    return {p.bulk_modulus / p.exponent * (j - integral), 0};
  }

  [[nodiscard]] double hardened(double xi) const { return std::exp(-xi * s.plastic_volume_change); }
};

}  // namespace

ElasticEnergy elastic_energy(const Law& law, const ElasticState& state) {
  return std::visit(EnergyOf{state}, law);
}

}  // namespace lather
