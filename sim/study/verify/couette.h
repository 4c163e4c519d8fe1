#pragma once

#include "sim/simulation.h"
#include "sim/study/verify/case.h"

namespace lather::study {

/// Start-up of shear in the Maxwell limit: by the law alone, and by the whole method in a periodic box.
[[nodiscard]] std::vector<Finding> verify_couette(int threads);

/// The box of that solver, over five relaxation times in so many frames.
[[nodiscard]] Scene couette(Solver solver, int frames);
/// Shear stress over the steady one, measured in that box, and exact after the time t (s).
[[nodiscard]] double couette_stress(const Simulation& simulation, const Scene& scene);
[[nodiscard]] double exact_couette_stress(double t);

}  // namespace lather::study
