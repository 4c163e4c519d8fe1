#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

const Table<Mlsrk>& mlsrk() {
  using M = Mlsrk;
  static const Table<M> table(
      "mlsrk", "How the solver \"mlsrk\" computes: moving least squares over the points, without a grid.",
      {optional<M>("basis", &M::basis,
                   enumeration<Basis>({{"constant", Basis::kConstant},
                                       {"linear", Basis::kLinear},
                                       {"quadratic", Basis::kQuadratic}}),
                   "polynomials that the shape functions reproduce; constant is Shepard's interpolation"),
       optional<M>(
           "kernel_shape", &M::kernel_shape,
           enumeration<KernelShape>({{"tensor", KernelShape::kTensor}, {"radial", KernelShape::kRadial}}),
           "weights as products over the axes, or by distance alone"),
       optional<M>("support_radius", &M::support_radius, number("spacings", from_to(1.5, kMaxSupportRadius)),
                   "R: points closer than this see each other"),
       optional<M>("regularization", &M::regularization, number("1", from_to(0, 1e6)),
                   "r: 0 reproduces the basis fully and fails where neighbours are few; large r tends to "
                   "Shepard's interpolation"),
       optional<M>("regularize_constant", &M::regularize_constant, flag(),
                   "regularize the constant as well: bodies then do not even fall freely"),
       optional<M>(
           "velocity_blend", &M::velocity_blend, number("1", from_to(0, 1)),
           "share of a point's own velocity, against its neighbourhood's, over one reference step; 1 is "
           "no blending"),
       optional<M>("velocity_blend_reference_step", &M::velocity_blend_reference_step,
                   number("s", above_to(0, 1)),
                   "the step for which velocity_blend is meant; a step dt uses velocity_blend^(dt / this)"),
       optional<M>(
           "inertial_mass", &M::inertial_mass,
           enumeration<InertialMass>({{"lumped", InertialMass::kLumped}, {"own", InertialMass::kOwn}}),
           "what forces are divided by: lumped mass, consistent at surfaces, or the point's own, which "
           "conserves momentum for good"),
       optional<M>(
           "volume_correction", &M::volume_correction, flag(),
           "take the volume of points that are liquid, or drucker-prager without cohesion, from their "
           "neighbours' distances"),
       optional<M>("phases", &M::phases, object_of(phase_numerics()), "how concentrations are computed",
                   "see phases")});
  return table;
}

}  // namespace lather::tables
