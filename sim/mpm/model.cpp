#include "sim/mpm/step.h"
#include "sim/plan/law_constants.h"

namespace lather::mpm {
namespace {

template <class Real>
MaterialConstants<Real> material_constants(const Scene& scene, const Material& material,
                                           const KernelTable<Real>& table) {
  const double volume = scene.point_volume();
  return {static_cast<Real>(material.density() * volume),
          static_cast<Real>(volume),
          static_cast<Real>(scene.points_per_cell - 1),
          law_constants<Real>(material.law, scene.dimension),
          {static_cast<Real>(material.tearing.tear_threshold)},
          table.laws[scene.dimension - 2][material.law.index()]};
}

resample::Resampler make_resampler(const Plan& plan, const CellBounds& bounds) {
  resample::Resampler r;
  r.lattice = resample::Lattice(plan.scene);
  r.bounds = bounds;
  const bool cubic = plan.scene.numerics.kernel == Kernel::kCubic;
  const PointKernels<double>& point = kernel_table<double>(plan.choices.kernel_level).point;
  r.weights = [cubic, weights = point.weights](double fraction, double* weight) {
    double derivative[4];
    return weights(cubic, fraction, weight, derivative);
  };
  r.nearest = kernel_table<float>(plan.choices.kernel_level).nearest;
  for (const Material& m : plan.scene.materials) {
    r.mass.push_back(m.density() * plan.scene.point_volume());
    r.tears.tear_threshold.push_back(m.tearing.tear_threshold);
  }
  r.tears.plasticity = point.tearing.plasticity;
  if (plan.scene.numerics.resampling) r.velocity = plan.scene.numerics.resampling->velocity;
  return r;
}

resample::SubgridSearch subgrid_search(const Scene& scene, const resample::Resampler& resampler) {
  resample::SubgridSearch search;
  search.thresholds = scene.numerics.subgrid_removal.value_or(SubgridRemoval{});
  search.tear_threshold = resampler.tears.tear_threshold;
  search.mass = resampler.mass;
  search.weights = resampler.weights;
  return search;
}

}  // namespace

template <class Real>
Model<Real>::Model(const Plan& plan) : scene(plan.scene), bounds(cell_bounds(plan.scene)), walls(plan.scene) {
  const bool cubic = scene.numerics.kernel == Kernel::kCubic;
  const bool apic = scene.numerics.transfer == Transfer::kApic;
  const KernelTable<Real>& table = kernel_table<Real>(plan.choices.kernel_level);
  point = table.point;
  kernels = table.step[scene.dimension - 2][cubic ? 1 : 0][apic ? 1 : 0];
  for (const Material& m : scene.materials) materials.push_back(material_constants(scene, m, table));
  resampler = make_resampler(plan, bounds);
  removal = subgrid_search(scene, resampler);
  // See kHomeShift. A little less, for the rounding of sums of displacements.
  drift_margin = (cubic ? 0.5 : 1.0) - 1e-3;
}

template struct Model<float>;
template struct Model<double>;

}  // namespace lather::mpm
