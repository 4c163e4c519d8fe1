#include "sim/simulation.h"

#include <omp.h>

#include <algorithm>

#include "sim/mpm/simulation.h"

namespace lather {

std::unique_ptr<Simulation> Simulation::create(const Plan& plan, int threads) {
  if (!machine_has(plan.choices.kernel_level))
    throw InputError(
        {{"/choices/kernel_level", to_string(plan.choices.kernel_level), to_string(best_kernel_level()),
          "This machine lacks the plan's kernel level, and another level gives other last digits."}});
  return mpm::create_simulation(plan, threads > 0 ? threads : std::max(1, omp_get_num_procs()));
}

const char* version() {
  return LATHER_VERSION;
}

}  // namespace lather
