#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "server/agent/runner.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"

namespace lather::server {
namespace {

constexpr int kRunnerFd = 3;

struct AllOptions {
  RunOptions run;
  RenderOptions render;
  SheetOptions sheet;
  PlanOptions plan;
  ServeOptions serve;
  AgentOptions worker;
  SubmitOptions submit;
  RheometerOptions rheometer;
  VerifyOptions verify;
  TradeoffOptions tradeoff;
  ScenesOptions needs;
  ScenesOptions forecast;
  BenchOptions bench;
  SoakOptions soak;
  bool version_json = false;
  int exit_code = 0;
};

void add_scene(CLI::App& command, SceneSource& scene) {
  command.add_option("SCENE", scene.file, "scene file (JSON)")->required();
  command.add_option("--size", scene.size, "one of the sizes that the scene names, e.g. preview");
  command.add_option("--set", scene.set, "change a field: /json/pointer=value; may be repeated")
      ->allow_extra_args(false);
}

void add_backend(CLI::App& command, std::string& backend) {
  command.add_option("--render-backend", backend, "auto, osmesa or egl")->capture_default_str();
}

void add_run(CLI::App& program, AllOptions& all) {
  CLI::App& command =
      *program.add_subcommand("run", "Simulate a scene and draw its frames, without a server");
  add_scene(command, all.run.scene);
  command
      .add_option("--out", all.run.out,
                  "directory for frames/, report.json, plan.json and the files that the scene asks for")
      ->required();
  command.add_option("--threads", all.run.threads, "threads of a step; 0: all cores")
      ->check(CLI::Range(0, 1024));
  add_backend(command, all.run.render_backend);
  command.add_flag("--json", all.run.json, "events as JSON lines on stdout");
  command.callback([&all] { all.exit_code = run_command(all.run); });
}

void add_render(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "render", "Draw the particles that a run kept again, with another camera or look");
  RenderOptions& render = all.render;
  command.add_option("DIR", render.kept, "what 'lather run' made: plan.json and particles/")->required();
  command.add_option("--look", render.look, "file of a look (JSON), in place of the scene's");
  command
      .add_option("--set", render.set,
                  "change a field: /look/...=value or /output/...=value; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--frames", render.frames, "one frame, or FIRST:LAST; all without it");
  command.add_option("--out", render.out, "directory for frames/ and report.json")->required();
  command.add_option("--threads", render.threads, "0: all cores")->check(CLI::Range(0, 1024));
  add_backend(command, render.render_backend);
  command.add_flag("--json", render.json, "events as JSON lines on stdout");
  command.callback([&all] { all.exit_code = render_command(all.render); });
}

void add_sheet(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "sheet", "Put pictures of runs on one sheet, a row a run, from first to last frame");
  SheetOptions& sheet = all.sheet;
  command.add_option("DIR", sheet.runs, "what 'lather run' made")->required();
  command.add_option("--pictures", sheet.pictures, "of each run")
      ->check(CLI::Range(1, 50))
      ->capture_default_str();
  command.add_option("--width", sheet.width, "of a picture on the sheet, px")
      ->check(CLI::Range(16, 4096))
      ->capture_default_str();
  command.add_option("--out", sheet.out, "the sheet, a PNG file")->required();
  command.callback([&all] { all.exit_code = sheet_command(all.sheet); });
}

void add_plan(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand("plan", "Say what a scene would cost: points, steps, memory");
  add_scene(command, all.plan.scene);
  command.add_flag("--json", all.plan.json, "the plan as JSON");
  command.callback([&all] { all.exit_code = plan_command(all.plan); });
}

void add_limits(CLI::App& command, JobLimits& limits) {
  command.add_option("--max-points", limits.points, "points a job may have")->capture_default_str();
  command.add_option("--max-frames", limits.frames, "frames a job may have")->capture_default_str();
  command.add_option("--max-pixels", limits.pixels, "pixels a frame may have")->capture_default_str();
  command
      .add_option("--max-memory", limits.memory_bytes,
                  "bytes a job may plan to use; 0: most of the machine's")
      ->capture_default_str();
  command.add_option("--max-point-steps", limits.point_steps, "points times steps a job may have")
      ->capture_default_str();
}

void add_store(CLI::App& command, AgentOptions& agent, const std::string& otherwise) {
  command
      .add_option(
          "--store", agent.store,
          "postgresql://[USER@]HOST[:PORT]/DATABASE; " + otherwise +
              ". The command line shows to everyone on the machine: leave the password to LATHER_STORE, "
              "PGPASSWORD or ~/.pgpass (PGPASSFILE); what the URI leaves out is taken from libpq's "
              "variables (PGHOST, PGUSER, PGSSLMODE, ...)")
      ->envname("LATHER_STORE");
  command
      .add_option("--lease-seconds", agent.lease_seconds,
                  "a runner that is silent for so long is ended and replaced; with --store, an agent loses "
                  "its jobs to others")
      ->capture_default_str()
      ->check(CLI::Range(2.0, 3600.0));
}

void add_agent(CLI::App& command, AgentOptions& agent, int fewest_workers) {
  command.add_option("--workers", agent.workers, "jobs at a time")
      ->capture_default_str()
      ->check(CLI::Range(fewest_workers, 256));
  command.add_option("--threads", agent.threads, "threads of each job; 0: the cores shared by the workers")
      ->check(CLI::Range(0, 1024));
  add_backend(command, agent.render_backend);
  command
      .add_option("--checkpoint-seconds", agent.checkpoint_seconds,
                  "time between two checkpoints of a job, from which it goes on after a break")
      ->capture_default_str()
      ->check(CLI::Range(0.02, 86400.0));
  command.add_option("--runner-memory", agent.runner_memory,
                     "address space of a runner in bytes; 0: no limit");
}

void add_serve(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand("serve", "Take scenes over HTTP, and show the page");
  ServeOptions& serve = all.serve;
  command.add_option("--host", serve.host, "address to listen on")->capture_default_str();
  command.add_option("--port", serve.port, "0: any that is free")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  command.add_flag("--allow-remote", serve.allow_remote, "listen on an address that others can reach");
  command.add_option("--allow-host", serve.allow_host, "a further name by which this server may be called");
  command.add_option("--data", serve.data, "directory of jobs and store, on a local disk")
      ->capture_default_str();
  command.add_option("--scenes", serve.scenes, "directory of example scenes for the page");
  add_store(command, serve.agent, "without it SQLite in the data directory");
  command.add_option(
      "--artifacts", serve.agent.artifacts,
      "directory of the jobs' files where workers share them; the data directory if not given");
  add_agent(command, serve.agent, 0);
  command.add_option("--ffmpeg", serve.ffmpeg, "program that makes films")->capture_default_str();
  command.add_option("--request-seconds", serve.request_seconds, "time for a request's head to arrive")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 3600.0));
  add_limits(command, serve.limits);
  command.callback([&all] { all.exit_code = serve_command(all.serve); });
}

void add_worker(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "worker", "Work on the jobs of a server elsewhere that keeps them in PostgreSQL");
  add_store(command, all.worker, "the database of the server");
  command
      .add_option("--artifacts", all.worker.artifacts,
                  "the server's directory of the jobs' files, as this machine sees it")
      ->required();
  add_agent(command, all.worker, 1);
  command.callback([&all] { all.exit_code = worker_command(all.worker); });
}

void add_submit(CLI::App& program, AllOptions& all) {
  CLI::App& command =
      *program.add_subcommand("submit", "Post a scene to a server, wait, and download its frames");
  add_scene(command, all.submit.scene);
  command.add_option("--server", all.submit.server, "http://HOST:PORT")->required();
  command.add_option("--out", all.submit.out,
                     "directory for frames/ and report.json; none: nothing is downloaded");
  command.add_flag("--json", all.submit.json, "the job's last state as JSON on stdout, no progress");
  command.callback([&all] { all.exit_code = submit_command(all.submit); });
}

void add_rheometer(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "rheometer", "Shear a material: its start-up curve, or its steady flow curve with --rates");
  RheometerOptions& o = all.rheometer;
  command.add_option("MATERIAL", o.material, "a preset's name, or a JSON file with a material")->required();
  command.add_option("--rate", o.rate, "shear rate of the start-up, 1/s")->capture_default_str();
  command.add_option("--time", o.time, "length of the start-up, s")->capture_default_str();
  command.add_option("--steps", o.steps, "intervals between readings")->capture_default_str();
  command.add_flag("--box", o.box, "shear a box of points by the whole method, not the law alone");
  command.add_option("--rates", o.rates, "steady flow curve: LOWEST:HIGHEST[:COUNT], 1/s, e.g. 0.01:100");
  command.add_option("--measured", o.measured,
                     "with --rates: a flow curve to set beside it, tau_y:K:n of tau_y + K rate^n");
  command.add_flag("--viscosity", o.viscosity,
                   "with --rates: the chart shows effective viscosity over stress");
  command.add_option("--threads", o.threads, "threads of the box; 0: all cores")->check(CLI::Range(0, 1024));
  command.add_flag("--json", o.json, "the whole curve as JSON");
  command.add_option("--chart", o.chart, "draw the curve into this file (.svg)");
  command.callback([&all] { all.exit_code = rheometer_command(all.rheometer); });
}

void add_verify(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "verify", "Compare simulations with exact solutions; fails if a bound is missed");
  command.add_option("CASE", all.verify.cases, "names of cases; none: all of them");
  command.add_flag("--quick", all.verify.quick, "without names: only the cases that take seconds");
  command.add_option("--threads", all.verify.threads, "threads of a step; 0: all cores")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--json", all.verify.json, "the table as JSON");
  command.callback([&all] { all.exit_code = verify_command(all.verify); });
}

void add_tradeoff(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "tradeoff", "Measure error against computing time over many settings of exact cases and scenes");
  TradeoffOptions& o = all.tradeoff;
  command.add_option(
      "SCENE|CASE", o.subjects,
      "scene files, each against its own finest run, and names of exact cases; none: all cases");
  command.add_option("--size", o.size, "of the scenes, e.g. preview");
  command.add_option("--set", o.set, "change a field of the scenes: /json/pointer=value; may be repeated")
      ->allow_extra_args(false);
  CLI::Option* knobs =
      command
          .add_option(
              "--knob", o.knobs,
              "NAME or NAME=VALUE,VALUE...; given several times, all combinations are run; without it "
              "each knob is turned alone")
          ->allow_extra_args(false);
  command.add_flag("--qualities", o.qualities, "the combinations that a scene's \"quality\" is picked from")
      ->excludes(knobs);
  command.add_flag("--quick", o.quick, "one repetition, and one value of each knob");
  command.add_option("--repeats", o.repeats, "of each run, for the noise of its time")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--threads", o.threads, "threads of a step; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--json", o.json, "write all that was measured into this file");
  command.add_option("--chart", o.chart, "draw error over time into this file (.png or .svg)");
  command.callback([&all] { all.exit_code = tradeoff_command(all.tradeoff); });
}

void add_scenes(CLI::App& command, ScenesOptions& o) {
  command.add_option("SCENE", o.scenes, "scene files")->required();
  command.add_option("--size", o.size, "of the scenes that name it, e.g. preview");
  command.add_option("--set", o.set, "change a field of all: /json/pointer=value; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--threads", o.threads, "threads of a step; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--seconds", o.seconds, "of a scene's trial")
      ->check(CLI::Range(0.01, 600.0))
      ->capture_default_str();
  command.add_option("--json", o.json, "write the table into this file");
}

void add_needs(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "needs", "Say which fields a scene's points carry and which stages run, with their shares of the time");
  add_scenes(command, all.needs);
  command.callback([&all] { all.exit_code = needs_command(all.needs); });
}

void add_forecast(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "forecast",
      "Run scenes and set their computing time beside what a short trial says, as budgets use it");
  add_scenes(command, all.forecast);
  command.callback([&all] { all.exit_code = forecast_command(all.forecast); });
}

void add_bench(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "bench", "Measure how fast the solvers are on this machine, beside what its cores can do");
  command.add_option("CASE", all.bench.cases,
                     "names of cases or scenes, or how they begin; none: all of them");
  command.add_option("--points", all.bench.points, "of the bodies: numbers with commas between")
      ->delimiter(',')
      ->check(CLI::Range(std::uint64_t{1000}, std::uint64_t{20'000'000}))
      ->capture_default_str();
  command.add_option("--threads", all.bench.threads, "of a step: numbers with commas between; 0: all cores")
      ->delimiter(',')
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command.add_option("--level", all.bench.kernel_level,
                     "x86-64-v2, x86-64-v3 or x86-64-v4; none: the best here");
  command.add_option("--seconds", all.bench.seconds, "of stepping, for each row")
      ->check(CLI::Range(0.01, 600.0))
      ->capture_default_str();
  CLI::Option* scaling =
      command.add_flag("--scaling", all.bench.scaling,
                       "how cost grows with points: the main case of each solver, 10,000 to 4 million");
  command
      .add_option("--papers", all.bench.papers,
                  "run the scenes of this list (docs/papers.json) and set what a frame costs beside what the "
                  "papers print")
      ->excludes(scaling);
  command.add_flag("--json", all.bench.json, "the table as JSON");
  command.callback([&all] { all.exit_code = bench_command(all.bench); });
}

void add_soak(CLI::App& program, AllOptions& all) {
  CLI::App& command = *program.add_subcommand(
      "soak",
      "Run random scenes over all that a scene may hold, and see that none breaks what none may break");
  SoakOptions& soak = all.soak;
  command.add_option("--scenes", soak.scenes, "how many")->capture_default_str();
  command.add_option("--seed", soak.seed, "the same scenes for the same number")->capture_default_str();
  command.add_option("--first", soak.first, "index of the first one")->capture_default_str();
  command.add_option("--steps", soak.most_steps, "of each scene, about, at most")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--keep", soak.keep,
                     "directory for scenes that break, as files; without it they are printed");
  command.add_flag("--json", soak.json, "the counts as JSON");
  command.callback([&all] { all.exit_code = soak_command(all.soak); });
}

void add_rest(CLI::App& program, AllOptions& all) {
  CLI::App& version = *program.add_subcommand("version", "Print the version");
  version.add_flag("--json", all.version_json, "as JSON");
  version.callback([&all] { all.exit_code = version_command(all.version_json); });
  program.add_subcommand("schema", "Print the JSON Schema of a scene")->callback([&all] {
    all.exit_code = schema_command();
  });
  program.add_subcommand("reference", "Print the scene format as Markdown tables")->callback([&all] {
    all.exit_code = reference_command();
  });
  // Started by a server for each attempt at a job; not for people.
  program.add_subcommand("runner", "")->group("")->callback([&all] {
    all.exit_code = runner_main(kRunnerFd);
  });
}

int parse_and_run(int argc, char** argv) {
  CLI::App program("Lather: foam simulated and drawn, without a screen", "lather");
  program.require_subcommand(1);
  AllOptions all;
  add_run(program, all);
  add_render(program, all);
  add_sheet(program, all);
  add_plan(program, all);
  add_serve(program, all);
  add_worker(program, all);
  add_submit(program, all);
  add_rheometer(program, all);
  add_verify(program, all);
  add_tradeoff(program, all);
  add_needs(program, all);
  add_forecast(program, all);
  add_bench(program, all);
  add_soak(program, all);
  add_rest(program, all);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? 0 : kExitBadInput;
  }
  return all.exit_code;
}

}  // namespace

int run_command_line(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const InputError& error) {
    print_problems("lather: this cannot be used:", error.problems());
    return kExitBadInput;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "lather: out of memory: choose a larger spacing or a smaller picture\n");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lather: %s\n", error.what());
  }
  return 1;
}

}  // namespace lather::server
