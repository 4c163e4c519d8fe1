#include "sim/plan/planned_fields.h"

#include <algorithm>

namespace lather {
namespace {

/// What a law keeps of a point.
struct LawFields {
  bool plastic_strain;  ///< is asked for

  std::vector<Field> operator()(const HerschelBulkleyParameters&) const {
    std::vector<Field> fields = {Field::kVolumeChange, Field::kElasticStrain};
    if (plastic_strain) fields.push_back(Field::kPlasticStrain);
    return fields;
  }
  std::vector<Field> operator()(const NeoHookeanParameters& p) const {
    return with_gradient({Field::kDeformation}, p.viscous);
  }
  std::vector<Field> operator()(const DruckerPragerParameters& p) const {
    return with_gradient({Field::kDeformation, Field::kPlasticVolume}, p.viscous);
  }
  std::vector<Field> operator()(const SnowParameters&) const {
    return {Field::kDeformation, Field::kPlasticVolume};
  }
  std::vector<Field> operator()(const LiquidParameters& p) const {
    return with_gradient({Field::kVolumeChange}, p.viscous);
  }

 private:
  /// Stress is computed before the step's own velocity gradient is known; the last step's stands in.
  static std::vector<Field> with_gradient(std::vector<Field> fields, const ViscousParameters& viscous) {
    if (viscous.any()) fields.push_back(Field::kVelocityGradient);
    return fields;
  }
};

/// Can a grip take points of the material?
bool may_be_gripped(const Scene& scene, const std::string& material) {
  for (const Grip& grip : scene.grips)
    for (const Body& body : scene.bodies) {
      if (!grip.body.empty() && grip.body != body.name) continue;
      const std::vector<std::string> names = body.material_names();
      if (std::find(names.begin(), names.end(), material) != names.end()) return true;
    }
  return false;
}

}  // namespace

std::vector<std::string> planned_scalars(const Scene& scene) {
  std::vector<std::string> scalars;
  if (scene.look.color_by != "material") scalars.push_back(scene.look.color_by);
  for (const std::string& name : scene.output.scalars)
    if (name != scene.look.color_by) scalars.push_back(name);
  return scalars;
}

std::vector<Field> planned_fields(const Scene& scene, const Material& material) {
  const std::vector<std::string> scalars = planned_scalars(scene);
  const bool plastic_strain = std::find(scalars.begin(), scalars.end(), "plastic_strain") != scalars.end();
  std::vector<Field> fields = {Field::kFraction, Field::kVelocity};
  const std::vector<Field> law = std::visit(LawFields{plastic_strain}, material.law);
  fields.insert(fields.end(), law.begin(), law.end());
  const bool grid = scene.solver == Solver::kMpm;
  if (material.phase) fields.push_back(Field::kConcentration);
  if (may_be_gripped(scene, material.name)) fields.push_back(Field::kGrip);
  fields.insert(fields.end(), {Field::kId, Field::kCell});
  if (grid && scene.numerics.transfer == Transfer::kApic) fields.push_back(Field::kAffine);
  if (grid && scene.numerics.resampling) fields.push_back(Field::kShare);
  if (grid && material.tearing.tears()) {
    fields.push_back(Field::kDeformation);
    fields.push_back(Field::kPlasticity);
  }
  return fields;
}

}  // namespace lather
