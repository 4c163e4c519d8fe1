#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

const Table<Resampling>& resampling() {
  using R = Resampling;
  static const Table<R> table(
      "resampling", "Points are inserted and merged so that no void opens inside deforming material.",
      {optional<R>("interval", &R::interval, number("s", above_to(0, kForever)),
                   "simulated time between two resamplings"),
       optional<R>("velocity", &R::velocity,
                   enumeration<NewVelocity>({{"conserving", NewVelocity::kConserving},
                                             {"interpolated", NewVelocity::kInterpolated}}),
                   "of a new point: the mean of the points that give it mass (keeps momentum), or "
                   "interpolated on the grid (the paper's way)")});
  return table;
}

const Table<SubgridRemoval>& subgrid_removal() {
  using R = SubgridRemoval;
  static const Table<R> table(
      "subgrid_removal",
      "Weak points in slivers and specks that the grid cannot resolve are removed, with their mass.",
      {optional<R>("interval", &R::interval, number("s", above_to(0, kForever)),
                   "simulated time between two searches"),
       optional<R>(
           "anisotropy", &R::anisotropy, number("1", from_to(0, 1)),
           "a point goes where the covariance of the points within its kernel has a smaller ratio of its "
           "least to its largest eigenvalue"),
       optional<R>("extent", &R::extent, number("1", from_to(0, 1)),
                   "or where the largest eigenvalue over spacing^2 is smaller than this")});
  return table;
}

const Table<Numerics>& numerics() {
  using N = Numerics;
  static const Table<N> table(
      "numerics",
      "How the scene is computed; every key has a sensible default. Kernel, transfer, FLIP and the keys of "
      "the "
      "semi-implicit solver are of the solver \"mpm\" and else without effect.",
      {optional<N>("kernel", &N::kernel,
                   enumeration<Kernel>({{"quadratic", Kernel::kQuadratic}, {"cubic", Kernel::kCubic}}),
                   "B-spline between points and grid"),
       optional<N>("transfer", &N::transfer,
                   enumeration<Transfer>({{"flip", Transfer::kFlip}, {"apic", Transfer::kApic}}),
                   "FLIP/PIC blend, or APIC"),
       optional<N>("precision", &N::precision,
                   enumeration<Precision>({{"float", Precision::kFloat}, {"double", Precision::kDouble}}),
                   "of the particles' and the grid's numbers"),
       optional<N>("flip_blend", &N::flip_blend, number("1", from_to(0, 1)),
                   "share of FLIP in the blend over one reference step; 0 is PIC"),
       optional<N>("flip_blend_reference_step", &N::flip_blend_reference_step, number("s", above_to(0, 1)),
                   "the step for which flip_blend is meant; a step dt uses flip_blend^(dt / this)"),
       optional<N>("time_step", &N::time_step, number("s", from_to(0, 10)), "0: chosen from the step bound"),
       optional<N>(
           "safety_factor", &N::safety_factor, number("1", above_to(0, 1)),
           "automatic step over its bound, spacing over wave speed; with the solver \"mpm\" never beyond "
           "what "
           "is stable for a point alone: 0.59 of the bound in 3D and 0.72 in 2D, with quadratic kernels "
           "0.43 and 0.52, or more where shear counts"),
       optional<N>("max_time_step", &N::max_time_step, number("s", above_to(0, kForever)),
                   "largest automatic step"),
       optional<N>("allowed_energy_gain", &N::allowed_energy_gain,
                   number_or_infinity("1", from_to(0, kForever)),
                   "a run ends with an error when kinetic, elastic and potential energy (zero where the "
                   "domain's is least) exceed those at t = 0 by this share, where nothing moves, comes in, "
                   "swells or has its volume corrected, which could give energy"),
       optional<N>("integration", &N::integration,
                   enumeration<Integration>(
                       {{"explicit", Integration::kExplicit}, {"semi-implicit", Integration::kSemiImplicit}}),
                   "how velocities are advanced: from the forces at hand, or solved for with the change of "
                   "forces over the step"),
       optional<N>("implicit_step_factor", &N::implicit_step_factor, number("1", from_to(1, 1000)),
                   "automatic semi-implicit step over the automatic explicit one"),
       optional<N>("implicit_share", &N::implicit_share, number("1", from_to(0.5, 1)),
                   "weight of the forces' change over a semi-implicit step; 1 damps waves most"),
       optional<N>("solver_tolerance", &N::solver_tolerance, number("1", from_to(1e-6, 0.5)),
                   "residual at which the semi-implicit solver stops, over its first one"),
       optional<N>("solver_iterations", &N::solver_iterations, integer(1, 10'000),
                   "most iterations of the semi-implicit solver in one step"),
       switchable<N>(
           "resampling", &N::resampling, resampling(),
           "inserts points where deformation would open voids, and merges crowded ones; {} takes the "
           "defaults"),
       switchable<N>(
           "subgrid_removal", &N::subgrid_removal, subgrid_removal(),
           "removes weak points that are too thin a sliver or speck for the grid; {} takes the defaults"),
       optional<N>("mlsrk", &N::mlsrk, object_of(mlsrk()), "of the solver \"mlsrk\"; else without effect",
                   "see mlsrk")});
  return table;
}

}  // namespace lather::tables
