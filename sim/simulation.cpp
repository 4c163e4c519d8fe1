#include "sim/simulation.h"

#include <omp.h>

#include <algorithm>

#include "sim/mlsrk/simulation.h"
#include "sim/mpm/simulation.h"

namespace lather {

std::unique_ptr<Simulation> Simulation::create(const Plan& plan, int threads) {
  if (!machine_has(plan.choices.kernel_level))
    throw InputError(
        {{"/choices/kernel_level", to_string(plan.choices.kernel_level), to_string(best_kernel_level()),
          "This machine lacks the plan's kernel level, and another level gives other last digits."}});
  const int used = threads > 0 ? threads : std::max(1, omp_get_num_procs());
  return plan.scene.solver == Solver::kMpm ? mpm::create_simulation(plan, used)
                                           : mlsrk::create_simulation(plan, used);
}

const char* version() {
  return LATHER_VERSION;
}

}  // namespace lather
