#include "sim/scene/tables.h"

namespace lather::tables {

using namespace descriptor;  // the vocabulary of tables

const Table<Numerics>& numerics() {
  using N = Numerics;
  static const Table<N> table(
      "numerics", "How the scene is computed; every key has a sensible default.",
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
       optional<N>("safety_factor", &N::safety_factor, number("1", above_to(0, 1)),
                   "automatic step over its bound"),
       optional<N>("max_time_step", &N::max_time_step, number("s", above_to(0, kForever)),
                   "largest automatic step")});
  return table;
}

}  // namespace lather::tables
