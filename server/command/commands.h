#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "server/http/limits.h"

/// The commands of the program. Each returns its exit code; InputError and other exceptions are reported by
/// run_command_line().
namespace lather::server {

inline constexpr int kExitBadInput = 2;
inline constexpr int kExitSimulation = 3;
inline constexpr int kExitInterrupted = 130;

/// A scene file and what is changed in it before it is read.
struct SceneSource {
  std::filesystem::path file;
  std::string size;
  std::vector<std::string> set;  ///< "/json/pointer=value"
};

struct RunOptions {
  SceneSource scene;
  std::filesystem::path out;
  int threads = 0;
  std::string render_backend = "auto";
  bool json = false;
};
int run_command(const RunOptions& options);

struct RenderOptions {
  std::filesystem::path kept;  ///< what `lather run` made: plan.json and particles/NNNNN.ply
  std::filesystem::path look;  ///< file of a look (JSON), "" for the run's
  std::vector<std::string> set;
  std::string frames;  ///< "N" or "FIRST:LAST"; "": all
  std::filesystem::path out;
  int threads = 0;
  std::string render_backend = "auto";
  bool json = false;
};
int render_command(const RenderOptions& options);

struct SheetOptions {
  std::vector<std::filesystem::path> runs;  ///< what `lather run` made, a row each
  int pictures = 5;                         ///< of each run, from its first frame to its last
  int width = 240;                          ///< of a picture on the sheet, px
  std::filesystem::path out;                ///< PNG
};
int sheet_command(const SheetOptions& options);

struct PlanOptions {
  SceneSource scene;
  bool json = false;
};
int plan_command(const PlanOptions& options);

/// What an agent needs, whether it is a server's own or a worker.
struct AgentOptions {
  std::string store;                ///< postgresql://…; "": SQLite in the data directory
  std::filesystem::path artifacts;  ///< directory of the jobs' files, seen by the server and all workers
  int workers = 1;
  int threads = 0;
  std::string render_backend = "auto";
  std::uint64_t runner_memory = 0;  ///< bytes; 0: no limit
  double lease_seconds = 15;        ///< from an agent's or a runner's last sign of life to its loss
  double checkpoint_seconds = 60;   ///< wall clock, between two checkpoints of a job
};

struct ServeOptions {
  std::string host = "127.0.0.1";
  int port = 8080;
  bool allow_remote = false;
  std::vector<std::string> allow_host;
  std::filesystem::path data = "lather-data";
  std::filesystem::path scenes;
  std::string ffmpeg = "ffmpeg";  ///< program that makes films
  double request_seconds = 10;    ///< for a request's head to arrive
  AgentOptions agent;
  JobLimits limits;
};
int serve_command(const ServeOptions& options);

/// An agent without HTTP.
int worker_command(const AgentOptions& options);

struct SubmitOptions {
  SceneSource scene;
  std::string server;
  std::filesystem::path out;
  bool json = false;
};
int submit_command(const SubmitOptions& options);

struct RheometerOptions {
  std::string material;  ///< a preset's name, or a file
  double rate = 1;       ///< 1/s
  double time = 3;       ///< s
  std::int64_t steps = 2000;
  std::string rates;     ///< "lowest:highest[:count]"; "": a start-up
  std::string measured;  ///< "tau_y:K:n" of a flow curve to show beside the material's; "": none
  bool box = false;
  bool viscosity = false;
  int threads = 0;
  bool json = false;
  std::filesystem::path chart;
};
int rheometer_command(const RheometerOptions& options);

struct VerifyOptions {
  std::vector<std::string> cases;  ///< none: all
  bool quick = false;              ///< of all, only those that take seconds
  int threads = 0;
  bool json = false;
};
/// 0 if all cases pass, else 1.
int verify_command(const VerifyOptions& options);

struct TradeoffOptions {
  std::vector<std::string> subjects;  ///< exact cases, or scene files; none: all cases
  std::string size;                   ///< of the scenes
  std::vector<std::string> set;       ///< in the scenes: "/json/pointer=value"
  std::vector<std::string> knobs;     ///< whose combinations are run; none: each knob alone
  bool qualities = false;             ///< the combinations that qualities are picked from
  bool quick = false;                 ///< one repetition, one value of each knob
  int repeats = 3;
  int threads = 1;
  std::filesystem::path json;   ///< file to write; "": none
  std::filesystem::path chart;  ///< .png or .svg; "": none
};
int tradeoff_command(const TradeoffOptions& options);

struct ScenesOptions {
  std::vector<std::filesystem::path> scenes;
  std::string size;              ///< taken of the scenes that name it
  std::vector<std::string> set;  ///< "/json/pointer=value"
  int threads = 1;
  double seconds = 0.3;        ///< of a trial
  std::filesystem::path json;  ///< file to write; "": none
};
/// Fields, bytes and stages of scenes.
int needs_command(const ScenesOptions& options);
/// How long whole runs take, beside what a trial says.
int forecast_command(const ScenesOptions& options);

struct BenchOptions {
  std::vector<std::string> cases;  ///< names, or how they begin; none: all
  std::vector<std::uint64_t> points = {60'000, 500'000, 2'000'000};
  std::vector<int> threads = {1, 0};  ///< 0: all cores
  std::string kernel_level;           ///< "": the machine's best
  double seconds = 2;                 ///< of stepping, for each row
  bool scaling = false;               ///< the main case of each solver at its own numbers of points
  std::filesystem::path papers;       ///< list of scenes to run in place of cases; "": none
  bool json = false;
};
int bench_command(const BenchOptions& options);

struct SoakOptions {
  std::uint64_t scenes = 100;
  std::uint64_t seed = 1;
  std::uint64_t first = 0;         ///< index of the first scene: one of a seed alone is drawn by its index
  std::uint64_t most_steps = 100;  ///< of each scene
  std::filesystem::path keep;      ///< directory for the scenes that break; "": they go to stderr
  bool json = false;
};
/// 0 if no scene breaks, else 1.
int soak_command(const SoakOptions& options);

int version_command(bool json);
int schema_command();
int reference_command();

/// Parses and runs; every error goes to stderr in words, and into the exit code.
int run_command_line(int argc, char** argv);

}  // namespace lather::server
