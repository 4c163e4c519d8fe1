// Steps of one scene of tests/support/feature_scenes.h, for a program that counts instructions to look at.
//
//   feature_steps NAME minimal|with|without
//
// What counts is done within lather_measured(). Without arguments the names, one a line.

#include <cstdio>
#include <memory>
#include <string>

#include "sim/simulation.h"
#include "tests/support/feature_scenes.h"

using lather::testing_support::feature_scenes;
using lather::testing_support::FeatureScene;

extern "C" {
/// All steps but the first frame's, which makes room for everything.
__attribute__((noinline)) void lather_measured(lather::Simulation* simulation, int last_frame) {
  for (int i = 2; i <= last_frame; ++i)
    simulation->step_to_frame(i, [](const lather::Progress&) { return true; });
}
}

namespace {

lather::Scene scene_of(const FeatureScene& feature, const std::string& which) {
  if (which == "minimal") return minimal_scene(feature);
  return which == "with" ? scene_with(feature) : scene_without(feature);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    for (const FeatureScene& feature : feature_scenes()) std::printf("%s\n", feature.name.c_str());
    return 0;
  }
  for (const FeatureScene& feature : feature_scenes()) {
    if (feature.name != argv[1]) continue;
    // Valgrind knows no AVX-512.
    const lather::Plan plan =
        make_plan(scene_of(feature, argv[2]), lather::Choices{lather::KernelLevel::kV3});
    const auto simulation = lather::Simulation::create(plan, 1);
    for (int i = 0; i <= 1; ++i) simulation->step_to_frame(i, [](const lather::Progress&) { return true; });
    lather_measured(simulation.get(), plan.frames - 1);
    return 0;
  }
  return 2;
}
