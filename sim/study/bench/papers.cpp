#include "sim/study/bench/papers.h"

#include <algorithm>
#include <cmath>

#include "sim/plan/step_bound.h"

namespace lather::study {
namespace {

/// One entry of the list, whose mistakes are reported with their place.
class Entry {
 public:
  Entry(const Value& value, std::string place) : value_(value), place_(std::move(place)) {}

  [[nodiscard]] bool has(const char* key) const { return value_.find(key) != nullptr; }
  [[nodiscard]] std::string text(const char* key) const {
    const Value* found = value_.find(key);
    if (found == nullptr || found->text() == nullptr) refuse(key, "a text");
    return *found->text();
  }
  [[nodiscard]] double positive(const char* key) const {
    const Value* found = value_.find(key);
    const std::optional<double> number = found != nullptr ? number_of(*found) : std::nullopt;
    if (!number || !(*number > 0)) refuse(key, "a number above 0");
    return *number;
  }
  /// The elements of a list that may be missing or null.
  [[nodiscard]] Array list(const char* key) const {
    const Value* found = value_.find(key);
    if (found == nullptr || std::holds_alternative<std::nullptr_t>(found->data)) return {};
    if (found->array() == nullptr) refuse(key, "a list");
    return *found->array();
  }
  [[nodiscard]] static std::optional<double> number_of(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&value.data)) return *real;
    return std::nullopt;
  }
  [[noreturn]] void refuse(const char* key, const char* allowed) const {
    throw InputError({{place_ + "/" + key, "", allowed, "This list of scenes cannot be used."}});
  }

 private:
  const Value& value_;
  std::string place_;
};

PaperScene read_entry(const Entry& entry) {
  PaperScene paper;
  paper.name = entry.text("name");
  paper.file = entry.text("scene");
  paper.machine = entry.text("machine");
  paper.frame_rate = entry.positive("frame_rate");
  paper.time_step = entry.positive("time_step");
  if (entry.has("start")) paper.start = entry.positive("start");
  for (const Value& change : entry.list("set")) {
    if (change.text() == nullptr) entry.refuse("set", "texts \"/json/pointer=value\"");
    paper.set.push_back(*change.text());
  }
  if (const Array printed = entry.list("seconds_per_frame"); !printed.empty()) {
    paper.least = Entry::number_of(printed.front());
    paper.most = Entry::number_of(printed.back());
    if (printed.size() != 2 || !paper.least || !paper.most) entry.refuse("seconds_per_frame", "two numbers");
  }
  return paper;
}

}  // namespace

std::vector<PaperScene> read_paper_scenes(std::string_view json) {
  const Value list = parse_json(json);
  std::vector<PaperScene> papers;
  const Array entries = Entry(list, "").list("scenes");
  for (std::size_t i = 0; i < entries.size(); ++i)
    papers.push_back(read_entry(Entry(entries[i], "/scenes/" + std::to_string(i))));
  return papers;
}

double step_of(const Scene& scene) {
  const double frame = 1 / scene.frame_rate;
  return frame / steps_for(frame, planned_step(scene, step_bound(scene)));
}

BenchCase paper_case(const PaperScene& paper, const Scene& scene) {
  const double own_step = step_of(scene);
  Scene run = scene;
  if (paper.start > 0) run.numerics.time_step = 0;
  const double step = step_of(run);
  BenchCase bench;
  if (run.numerics.resampling) {
    bench.steps = std::max(1, static_cast<int>(std::round(run.numerics.resampling->interval / own_step)));
    run.numerics.resampling->interval *= step / own_step;
  }
  bench.name = paper.name;
  bench.scene = [run](std::uint64_t) { return run; };
  bench.start = paper.start;
  return bench;
}

Array to_json(const std::vector<PaperRun>& runs) {
  Array rows;
  for (const PaperRun& run : runs) {
    const PaperScene& paper = run.paper;
    const Value printed = paper.least ? Value(Array{*paper.least, *paper.most}) : Value(nullptr);
    rows.emplace_back(Object{{"name", paper.name},
                             {"threads", static_cast<std::int64_t>(run.result.threads)},
                             {"start", paper.start},
                             {"time_step", run.time_step},
                             {"steps_per_frame", run.steps_per_frame()},
                             {"seconds_per_frame", run.seconds_per_frame()},
                             {"printed", printed}});
  }
  return rows;
}

}  // namespace lather::study
