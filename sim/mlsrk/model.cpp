#include <algorithm>
#include <cmath>

#include "sim/mlsrk/loose_cloud.h"
#include "sim/mlsrk/step.h"
#include "sim/plan/law_constants.h"
#include "sim/plan/step_bound.h"

namespace lather::mlsrk {
namespace {

/// Pivots of a moment matrix over the kernel's own moments, which are of order 1, below which its inverse has
/// lost half its digits.
template <class Real>
constexpr Real kSmallestPivot = sizeof(Real) == 4 ? Real(3e-4) : Real(1e-8);

/// At a concentration of the material, where its law is `law`.
template <class Real>
LawConstants<Real> swollen_constants(const Law& law, const Material& material, int dimension) {
  LawConstants<Real> c = law_constants<Real>(law, dimension);
  c.swelling = static_cast<Real>(material.density() / density(law));  // J_r = rho0/rho [MLSRK eq. 30]
  return c;
}

template <class Real>
MaterialConstants<Real> material_constants(const Scene& scene, const Material& material) {
  MaterialConstants<Real> c{};
  c.volume = static_cast<Real>(scene.point_volume());
  c.mass = static_cast<Real>(material.density() * scene.point_volume());
  c.corrected = scene.numerics.mlsrk.volume_correction && material.takes_volume_correction();
  c.law = law_constants<Real>(material.law, scene.dimension);
  return c;
}

/// Of the material's squared wave speed in the one that the bound of steps allows for: at most 1 where it is
/// in use.
double wave_share(const Scene& scene, const Material& material, double bound) {
  double fastest = 0;
  for (const Law& law : material.laws()) fastest = std::max(fastest, wave_speed(law));
  return std::pow(fastest * bound / scene.spacing, 2);
}

/// sum_j Phi at a point of a lattice that fills its whole support, by the kernel itself.
template <class Real>
Real full_lattice(const Scene& scene, const Kernels<Real>& kernels, const ShapeConstants<Real>& constants) {
  const double step = 2 / scene.numerics.mlsrk.support_radius;  // d/a
  constexpr int kReach = 4;                                     // the largest support radius
  const int across = scene.dimension == 3 ? kReach : 0;
  LooseCloud<Real> lattice;
  lattice.add(Vec3::Zero(), 1);
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -kReach; y <= kReach; ++y)
      for (int z = -across; z <= across; ++z)
        if (x != 0 || y != 0 || z != 0) lattice.add(Vec3(x, y, z) * step, 1);
  std::vector<Real> shape(static_cast<std::size_t>(kernels.shape_reals) * kTile);
  Real crowding[kTile];
  Real fallen[kTile];
  kernels.shape_functions(constants, lattice.around(0), shape.data(), crowding, fallen);
  return crowding[0];
}

}  // namespace

template <class Real>
Model<Real>::Model(const Plan& plan) : scene(plan.scene), bounds(cell_bounds(plan.scene)), walls(plan.scene) {
  const Mlsrk& n = scene.numerics.mlsrk;
  const KernelTable<Real>& table = kernel_table<Real>(plan.choices.kernel_level);
  const auto dimension = static_cast<std::size_t>(scene.dimension - 2);
  kernels = table.wide[dimension][static_cast<int>(n.basis)][n.kernel_shape == KernelShape::kRadial ? 1 : 0];
  positions = table.positions[dimension];
  phases = table.phases[dimension][static_cast<int>(n.basis)][n.kernel_shape == KernelShape::kRadial ? 1 : 0];
  static_assert(kConcentrationSteps == kConcentrationNodes);
  for (const Material& m : scene.materials) {
    wave_shares.push_back(wave_share(scene, m, plan.step_bound));
    swells = swells || (m.phase && m.phase->curve_of("density") != nullptr);
    std::vector<LawConstants<Real>> constants;
    const std::vector<Law> by_c = m.laws();
    if (by_c.size() > 1)
      for (const Law& law : by_c) constants.push_back(swollen_constants<Real>(law, m, scene.dimension));
    laws.push_back(table.laws[dimension][constants.empty() ? 0 : 1][m.law.index()]);
    materials.push_back(material_constants<Real>(scene, m));
    corrects = corrects || materials.back().corrected;
    by_concentration.push_back(std::move(constants));
    if (!by_concentration.back().empty()) materials.back().by_concentration = by_concentration.back().data();
  }
  if (corrects) stand_off = 0.5 * scene.spacing;
  shape.regularization = static_cast<Real>(n.regularization);
  shape.constant_regularization = static_cast<Real>(n.regularize_constant ? n.regularization : 0);
  shape.smallest_pivot = kSmallestPivot<Real>;
  lattice_crowding = full_lattice(scene, kernels, shape);
}

template struct Model<float>;
template struct Model<double>;

}  // namespace lather::mlsrk
