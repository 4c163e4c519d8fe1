#include <cstdio>
#include <string>

#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"
#include "sim/scene/value.h"
#include "sim/simulation.h"
#include "sim/study/cpu_clock.h"
#include "sim/study/forecast.h"

namespace lather::server {
namespace {

/// The whole run, without pictures.
struct Actual {
  double cpu = 0;  ///< s, in steps and in what is measured at every frame
  double point_steps = 0;
};

Actual run_all(const Plan& plan, int threads) {
  const auto simulation = Simulation::create(plan, threads);
  const double before = study::cpu_seconds();
  for (int i = 0; i < plan.frames; ++i) simulation->step_to_frame(i, [](const Progress&) { return true; });
  return {study::cpu_seconds() - before, static_cast<double>(simulation->report().point_steps)};
}

Object measured(const std::string& name, const Plan& plan, const ScenesOptions& options) {
  const study::Forecast forecast = study::forecast(plan, options.threads, options.seconds);
  Object out = {
      {"name", name}, {"predicted_seconds", forecast.cpu}, {"predicted_point_steps", forecast.point_steps}};
  try {
    const Actual actual = run_all(plan, options.threads);
    std::printf("%-24s %12.3g %12.3g %8.2f %16.2f\n", name.c_str(), forecast.cpu, actual.cpu,
                forecast.cpu / actual.cpu, forecast.point_steps / actual.point_steps);
    out.emplace_back("actual_seconds", actual.cpu);
    out.emplace_back("point_steps", actual.point_steps);
  } catch (const SimulationError& error) {
    std::printf("%-24s %s\n", name.c_str(), error.what());
    out.emplace_back("failure", error.what());
  }
  std::fflush(stdout);
  return out;
}

}  // namespace

int forecast_command(const ScenesOptions& options) {
  std::printf("%-24s %12s %12s %8s %16s\n", "scene", "predicted, s", "actual, s", "ratio", "of point-steps");
  Array scenes;
  for (const std::filesystem::path& file : options.scenes)
    scenes.emplace_back(measured(file.stem().string(), make_plan(scene_of(options, file)), options));
  if (!options.json.empty())
    write_whole(options.json, write_json(Object{{"scenes", std::move(scenes)}}, 1) + "\n");
  return 0;
}

}  // namespace lather::server
