#include "sim/study/tradeoff/tradeoff.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "sim/error.h"
#include "sim/study/cpu_clock.h"
#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Run {
  std::vector<Measure> measures;
  double seconds = 0;
  double wall = 0;
  Report report;
};

/// Steps through all frames; what the watch does is not counted.
Run run_once(const Subject& subject, const Scene& scene, int threads) {
  const auto simulation = Simulation::create(make_plan(scene), threads);
  const std::unique_ptr<Watch> watch = subject.watch(scene);
  Run run;
  for (int i = 0; i <= scene.last_frame(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    const double before = cpu_seconds();
    run_to(*simulation, i);
    run.seconds += cpu_seconds() - before;
    run.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    watch->see(*simulation);
  }
  run.measures = watch->measures();
  run.report = simulation->report();
  return run;
}

double largest(const std::vector<Measure>& measures) {
  double error = 0;
  for (const Measure& m : measures)
    error = std::isnan(m.error) ? kNan : std::max(error, m.error);  // NaN stays: max(NaN, x) is NaN
  return error;
}

/// The same run until it has taken `least` seconds; its times are the mean.
Run repeated(const Subject& subject, const Scene& scene, const TradeRequest& request) {
  Run run = run_once(subject, scene, request.threads);
  int times = 1;
  for (; run.seconds < request.least_seconds; ++times) {
    const Run again = run_once(subject, scene, request.threads);
    run.seconds += again.seconds;
    run.wall += again.wall;
  }
  run.seconds /= times;
  run.wall /= times;
  return run;
}

void note(const Run& run, TradePoint& point) {
  const double error = largest(run.measures);
  if (!point.seconds.empty() && error != point.error)
    throw std::logic_error("Two runs of the same scene differ: " + to_text(point.settings));
  point.measures = run.measures;
  point.error = error;
  point.seconds.push_back(run.seconds);
  point.wall.push_back(run.wall);
  point.steps = run.report.steps;
  point.point_steps = run.report.point_steps;
  point.points = run.report.frames.back().points;
}

/// The scenes of all settings, each once; settings that make none get the reason.
void add_points(const Subject& subject, const std::vector<Settings>& settings, TradeResult& result,
                std::vector<Scene>& scenes) {
  std::vector<std::string> texts;
  for (const Settings& s : settings) {
    TradePoint point;
    point.settings = s;
    Scene scene;
    try {
      scene = subject.scene(s);
    } catch (const InputError& error) {
      point.failure = error.problems().front().message;
      point.error = kNan;
    }
    const std::string text = to_json(scene);
    if (point.failure.empty() && std::find(texts.begin(), texts.end(), text) != texts.end()) continue;
    if (point.failure.empty()) texts.push_back(text);
    result.points.push_back(std::move(point));
    scenes.push_back(std::move(scene));
  }
}

void mark_dominated(std::vector<TradePoint>& points) {
  for (TradePoint& p : points)
    p.dominated = std::any_of(points.begin(), points.end(), [&](const TradePoint& other) {
      return dominated(p.on_front(), other.on_front());
    });
}

Value number(double x) {
  return std::isfinite(x) ? Value(x) : Value();  // JSON has no NaN
}

Array numbers(const std::vector<double>& list) {
  Array out;
  for (const double x : list) out.emplace_back(x);
  return out;
}

Object to_json(const TradePoint& p) {
  Object measures;
  for (const Measure& m : p.measures) measures.emplace_back(m.what, number(m.error));
  Object out = {{"settings", to_json(p.settings)},
                {"error", number(p.error)},
                {"measures", std::move(measures)},
                {"seconds", numbers(p.seconds)},
                {"wall_seconds", numbers(p.wall)},
                {"points", static_cast<std::int64_t>(p.points)},
                {"steps", static_cast<std::int64_t>(p.steps)},
                {"point_steps", static_cast<std::int64_t>(p.point_steps)},
                {"dominated", p.dominated}};
  if (!p.failure.empty()) out.emplace_back("failure", p.failure);
  return out;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError({{"", what, "a result of lather tradeoff --json", "This is no measured trade."}});
}

const Value& member(const Value& json, const char* key) {
  const Value* found = json.find(key);
  if (found == nullptr) refuse(key);
  return *found;
}

double number_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  return kNan;
}

std::vector<double> numbers_in(const Value& value) {
  if (value.array() == nullptr) refuse("seconds");
  std::vector<double> out;
  for (const Value& v : *value.array()) out.push_back(number_in(v));
  return out;
}

std::string text_in(const Value& value) {
  if (value.text() == nullptr) refuse(write_json(value));
  return *value.text();
}

bool flag_in(const Value& value) {
  const bool* flag = std::get_if<bool>(&value.data);
  if (flag == nullptr) refuse(write_json(value));
  return *flag;
}

Settings read_settings(const Value& json) {
  if (json.object() == nullptr) refuse("settings");
  Settings settings;
  for (const auto& [name, value] : *json.object()) {
    const Knob& knob = knob_named(name);
    settings.push_back({knob.name, knob.pointer, knob.turn, value});
  }
  return settings;
}

TradePoint read_point(const Value& json) {
  TradePoint p;
  p.settings = read_settings(member(json, "settings"));
  p.error = number_in(member(json, "error"));
  for (const auto& [what, error] : *member(json, "measures").object())
    p.measures.push_back({what, number_in(error)});
  p.seconds = numbers_in(member(json, "seconds"));
  p.wall = numbers_in(member(json, "wall_seconds"));
  p.points = static_cast<std::uint64_t>(number_in(member(json, "points")));
  p.steps = static_cast<std::uint64_t>(number_in(member(json, "steps")));
  p.point_steps = static_cast<std::uint64_t>(number_in(member(json, "point_steps")));
  p.dominated = flag_in(member(json, "dominated"));
  if (const Value* failure = json.find("failure")) p.failure = text_in(*failure);
  return p;
}

/// Of the same settings in every result: error and cost over the first point's, as geometric means.
std::optional<FrontPoint> mean_factor(const std::vector<TradeResult>& results, const Settings& settings) {
  FrontPoint log;
  for (const TradeResult& r : results) {
    const std::string wanted = write_json(to_json(settings));
    const auto found = std::find_if(r.points.begin(), r.points.end(), [&](const TradePoint& p) {
      return write_json(to_json(p.settings)) == wanted;
    });
    if (found == r.points.end() || !found->failure.empty() || !std::isfinite(found->error))
      return std::nullopt;
    const FrontPoint own = found->on_front();
    const FrontPoint first = r.points.front().on_front();
    const auto count = static_cast<double>(results.size());
    log.error += std::log(own.error / first.error) / count;
    log.cost += std::log(own.cost / first.cost) / count;
    log.cheapest += std::log(own.cheapest / first.cost) / count;
    log.dearest += std::log(own.dearest / first.cost) / count;
  }
  return FrontPoint{std::exp(log.error), std::exp(log.cost), std::exp(log.cheapest), std::exp(log.dearest)};
}

}  // namespace

double median(std::vector<double> numbers) {
  const std::size_t middle = numbers.size() / 2;
  std::sort(numbers.begin(), numbers.end());
  return numbers.size() % 2 == 1 ? numbers[middle] : 0.5 * (numbers[middle - 1] + numbers[middle]);
}

FrontPoint TradePoint::on_front() const {
  if (seconds.empty()) return {kNan, kNan, kNan, kNan};
  const auto [low, high] = std::minmax_element(seconds.begin(), seconds.end());
  return {error, median(seconds), *low, *high};
}

TradeResult run_tradeoff(const Subject& subject, const std::vector<Settings>& settings,
                         const TradeRequest& request) {
  TradeResult result;
  result.name = subject.name;
  result.error_of = subject.error_of;
  result.exact = subject.exact;
  std::vector<Scene> scenes;
  add_points(subject, settings, result, scenes);
  result.solver = scenes.front().solver == Solver::kMpm ? "mpm" : "mlsrk";
  const int all = request.repeats * static_cast<int>(scenes.size());
  int done = 0;
  for (int repeat = 0; repeat < request.repeats; ++repeat)
    for (std::size_t i = 0; i < scenes.size(); ++i, ++done) {
      TradePoint& point = result.points[i];
      if (!point.failure.empty()) continue;
      if (request.progress) request.progress(subject.name + ": " + to_text(point.settings), done, all);
      try {
        note(repeated(subject, scenes[i], request), point);
      } catch (const SimulationError& error) {
        point.failure = error.what();
        point.error = kNan;
      } catch (const InputError& error) {  // no plan can be made of it
        point.failure = error.problems().front().message;
        point.error = kNan;
      }
    }
  mark_dominated(result.points);
  return result;
}

std::vector<MeanPoint> mean_points(const std::vector<TradeResult>& results) {
  std::vector<MeanPoint> means;
  if (results.empty()) return means;
  for (const TradePoint& p : results.front().points)
    if (const std::optional<FrontPoint> factor = mean_factor(results, p.settings))
      means.push_back({p.settings, *factor});
  return means;
}

Object to_json(const TradeResult& result) {
  Array points;
  for (const TradePoint& p : result.points) points.emplace_back(to_json(p));
  return {{"name", result.name},
          {"error_of", result.error_of},
          {"exact", result.exact},
          {"solver", result.solver},
          {"points", std::move(points)}};
}

TradeResult read_trade_result(const Value& json) {
  TradeResult result;
  result.name = text_in(member(json, "name"));
  result.error_of = text_in(member(json, "error_of"));
  result.exact = flag_in(member(json, "exact"));
  result.solver = text_in(member(json, "solver"));
  if (member(json, "points").array() == nullptr) refuse("points");
  for (const Value& point : *member(json, "points").array()) result.points.push_back(read_point(point));
  return result;
}

}  // namespace lather::study
