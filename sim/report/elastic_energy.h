#pragma once

#include "sim/math/vec.h"
#include "sim/scene/scene.h"

namespace lather {

/// What a material's law keeps of a point, as far as its energy depends on it; 0 where it does not.
struct ElasticState {
  double volume_change = 0;          ///< J - 1
  double trace_elastic_strain = 0;   ///< of be - I
  Mat3 deformation = Mat3::Zero();   ///< F_e - I
  double plastic_volume_change = 0;  ///< J_p - 1
};

/// Elastic energy per volume at rest, Pa, by parts.
struct ElasticEnergy {
  double volume = 0;
  double shear = 0;
};

/// [Foam eq. 1] of Herschel-Bulkley materials; [MLSRK eq. 20] of solids, with the moduli as hardened [MLSRK
/// eq. 25] and log^2 J as the volume's part; of liquids the work that compression has taken, and nothing in
/// tension. Not a number where F_e is turned inside out.
[[nodiscard]] ElasticEnergy elastic_energy(const Law& law, const ElasticState& state);

}  // namespace lather
