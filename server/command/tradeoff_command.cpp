#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "render/chart.h"
#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"
#include "sim/scene/descriptor.h"
#include "sim/study/tradeoff/tradeoff.h"

namespace lather::server {
namespace {

using study::FrontPoint;
using study::Knob;
using study::Settings;
using study::Subject;
using study::TradePoint;
using study::TradeResult;

constexpr const char* kTimeIs =
    "the process's CPU time in the steps, of all its threads: the median of the repetitions";

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Subject& s : study::exact_subjects()) names.push_back(s.name);
  return names;
}

/// An exact case by its name, or a scene's file.
Subject subject_named(const std::string& name, const TradeoffOptions& options) {
  for (const Subject& s : study::exact_subjects())
    if (s.name == name) return s;
  if (!std::filesystem::exists(name)) {
    const std::string near = descriptor::nearest_name(name, case_names());
    throw InputError(
        {{"", name, descriptor::listed(case_names()) + ", or a scene's file",
          "There is no such case or file." + (near.empty() ? "" : " Did you mean \"" + near + "\"?")}});
  }
  std::fprintf(stderr, "%s: its finest run\n", name.c_str());
  Subject subject = study::scene_subject(read_scene({name, options.size, options.set}), options.threads);
  subject.name = std::filesystem::path(name).stem().string();
  return subject;
}

/// What is run of a subject; its plain scene first.
std::vector<Settings> settings_for(const Scene& scene, const TradeoffOptions& options) {
  std::vector<Knob> knobs;
  bool alone = false;
  if (options.qualities) {
    knobs = study::quality_knobs(scene.solver);
  } else if (!options.knobs.empty()) {
    for (const std::string& text : options.knobs) knobs.push_back(study::read_knob(text));
  } else {
    alone = true;
    for (const Knob& knob : study::knobs())
      if (knob.numerics) knobs.push_back(knob);
  }
  knobs.erase(std::remove_if(knobs.begin(), knobs.end(),
                             [&](const Knob& knob) { return !study::turns(knob, scene); }),
              knobs.end());
  if (options.quick)
    for (Knob& knob : knobs) knob.values.resize(1);
  std::vector<Settings> settings = {{}};
  const std::vector<Settings> more = alone ? study::one_at_a_time(knobs) : study::product(knobs);
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

void print_result(const TradeResult& result) {
  std::printf("%s: %s\n", result.name.c_str(), result.error_of.c_str());
  std::printf("  %-62s %10s %9s %7s %9s %12s\n", "settings", "error", "CPU, s", "spread", "wall, s",
              "point-steps");
  for (const TradePoint& p : result.points) {
    const std::string what = study::to_text(p.settings);
    if (!p.failure.empty()) {
      std::printf("  %-62s failed: %s\n", what.c_str(), p.failure.c_str());
      continue;
    }
    const FrontPoint at = p.on_front();
    std::printf("  %-62s %10.3g %9.3f %5.1f %% %9.3f %12.3g  %s\n", what.c_str(), at.error, at.cost,
                100 * (at.dearest - at.cheapest) / at.cost, study::median(p.wall),
                static_cast<double>(p.point_steps), p.dominated ? "dominated" : "");
  }
  std::printf("\n");
  std::fflush(stdout);
}

/// All points of each subject, and the front among them.
render::Chart chart_of(const std::vector<TradeResult>& results) {
  render::Chart chart;
  chart.title = "Error against computing time";
  chart.x = {"CPU time (s)", true};
  chart.y = {"error", true};
  for (const TradeResult& r : results) {
    render::ChartSeries all;
    std::vector<FrontPoint> points;
    for (const TradePoint& p : r.points) {
      points.push_back(p.on_front());
      all.x.push_back(points.back().cost);
      all.y.push_back(points.back().error);
    }
    all.name = r.name;
    all.dots = true;
    render::ChartSeries front;
    front.name = r.name + ", front";
    front.color = chart.series.size();
    for (const std::size_t i : study::front_of(points)) {
      front.x.push_back(points[i].cost);
      front.y.push_back(points[i].error);
    }
    chart.series.push_back(std::move(all));
    chart.series.push_back(std::move(front));
  }
  return chart;
}

/// By the ending of the file's name.
void write_chart(const std::filesystem::path& file, const std::vector<TradeResult>& results) {
  if (file.empty()) return;
  const render::Chart chart = chart_of(results);
  if (file.extension() == ".svg") {
    write_whole(file, render::to_svg(chart));
    return;
  }
  write_whole(file, render::encode_png(render::draw_chart(chart), {"", version(), chart.title, 0, 0}));
}

std::string processor() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  gmtime_r(&now, &date);
  std::array<char, 16> text{};
  std::strftime(text.data(), text.size(), "%F", &date);
  return text.data();
}

Object picked(const std::vector<study::MeanPoint>& means) {
  std::vector<FrontPoint> points;
  for (const study::MeanPoint& m : means) points.push_back(m.factor);
  Object out;
  if (means.empty()) return out;
  // The first is the scene with its defaults.
  const auto picks = study::pick_qualities(points, points.front());
  if (!picks) return out;
  const std::pair<const char*, std::size_t> named[] = {{"draft", picks->draft},
                                                       {"standard", picks->standard},
                                                       {"fine", picks->fine},
                                                       {"reference", picks->reference}};
  for (const auto& [name, i] : named)
    out.emplace_back(name, Object{{"settings", study::to_json(means[i].settings)},
                                  {"error_factor", means[i].factor.error},
                                  {"cost_factor", means[i].factor.cost}});
  return out;
}

/// What the rule picks for each solver.
Object picked_qualities(const std::vector<TradeResult>& results) {
  Object out;
  for (const char* solver : {"mpm", "mlsrk"}) {
    std::vector<TradeResult> own;
    for (const TradeResult& r : results)
      if (r.solver == solver) own.push_back(r);
    if (!own.empty()) out.emplace_back(solver, picked(study::mean_points(own)));
  }
  return out;
}

void print_qualities(const Object& qualities) {
  for (const auto& [solver, picks] : qualities)
    for (const auto& [name, pick] : *picks.object())
      std::printf("%-6s %-10s %s\n", solver.c_str(), name.c_str(), write_json(pick).c_str());
}

void check(const TradeoffOptions& o) {
  const std::string ending = o.chart.extension().string();
  if (!o.chart.empty() && ending != ".svg" && ending != ".png")
    throw InputError(
        {{"", "--chart " + o.chart.string(), "a file that ends in .png or .svg", "Charts are PNG or SVG."}});
}

}  // namespace

int tradeoff_command(const TradeoffOptions& options) {
  check(options);
  study::TradeRequest request;
  request.threads = options.threads;
  request.repeats = options.quick ? 1 : options.repeats;
  request.least_seconds = options.quick ? 0 : 0.1;
  request.progress = [](const std::string& what, int done, int all) {
    std::fprintf(stderr, "%d of %d: %s\n", done + 1, all, what.c_str());
  };
  std::vector<TradeResult> results;
  for (const std::string& name : options.subjects.empty() ? case_names() : options.subjects) {
    const Subject subject = subject_named(name, options);
    results.push_back(study::run_tradeoff(subject, settings_for(subject.scene({}), options), request));
    print_result(results.back());
  }
  std::printf("time: %s\n", kTimeIs);
  write_chart(options.chart, results);
  Object json = {{"lather_tradeoff", std::int64_t{1}},
                 {"version", version()},
                 {"measured", today()},
                 {"machine", Object{{"processor", processor()},
                                    {"cores", static_cast<std::int64_t>(std::thread::hardware_concurrency())},
                                    {"kernel_level", to_string(best_kernel_level())}}},
                 {"threads", static_cast<std::int64_t>(options.threads)},
                 {"repeats", static_cast<std::int64_t>(request.repeats)},
                 {"time", kTimeIs}};
  Array subjects;
  for (const TradeResult& r : results) subjects.emplace_back(study::to_json(r));
  json.emplace_back("subjects", std::move(subjects));
  if (options.qualities) {
    json.emplace_back("qualities", picked_qualities(results));
    print_qualities(*json.back().second.object());
  }
  if (!options.json.empty()) write_whole(options.json, write_json(json, 1) + "\n");
  return 0;
}

}  // namespace lather::server
