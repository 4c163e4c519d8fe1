#include <cstdio>

#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/run_events.h"
#include "server/command/scene_source.h"
#include "server/run/budget.h"
#include "server/run/run.h"
#include "sim/plan/plan.h"

namespace lather::server {
namespace {

int conclude(const Report& report, const RunOptions& options) {
  if (report.state == "cancelled") {
    std::fprintf(stderr, "interrupted; the frames made so far are in %s\n", (options.out / "frames").c_str());
    return kExitInterrupted;
  }
  if (report.state != "succeeded") {
    std::fprintf(stderr, "%s\nthe frames made before it are in %s\n", report.error.c_str(),
                 (options.out / "frames").c_str());
    return kExitSimulation;
  }
  if (!options.json)
    std::printf("%zu frames in %s\nreport in %s\n", report.frames.size(), (options.out / "frames").c_str(),
                (options.out / "report.json").c_str());
  if (!options.json && !report.probes.empty())
    std::printf("probes in %s\n", (options.out / "probes.csv").c_str());
  return 0;
}

}  // namespace

int run_command(const RunOptions& options) {
  const Plan plan = plan_in_budget(read_scene(options.scene), options.threads, options.render_backend);
  const std::atomic<Stop>& interrupted = heed_interrupts();
  std::filesystem::create_directories(options.out);
  write_whole(options.out / "plan.json", to_json(plan));
  const RunSettings settings = {options.out / "frames",     options.out / "report.json",
                                options.out / "probes.csv", options.threads,
                                options.render_backend,     options.out};
  const Report report =
      with_events(options.json, [&](RunEvents& events) { return run(plan, settings, events, interrupted); });
  return conclude(report, options);
}

}  // namespace lather::server
