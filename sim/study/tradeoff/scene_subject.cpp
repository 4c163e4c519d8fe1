#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim/study/scene_parts.h"
#include "sim/study/tradeoff/subject.h"

namespace lather::study {
namespace {

/// What one run looked like: motion at every frame, and where its mass was at the end.
struct Trace {
  std::vector<double> t;  ///< s
  std::vector<Vec3> center;
  std::vector<Vec3> lowest;
  std::vector<Vec3> highest;
  double torn_at = -1;  ///< s, of the first frame with a torn point; below 0: none
  /// Shares of the mass by cell, spread over the cells around each point; of the last frame.
  std::map<std::array<int, 3>, double> field;
};

/// The share of the mass in cells of width `cell` (m), each point spread linearly over the 2^d nearest.
std::map<std::array<int, 3>, double> mass_field(const Simulation& simulation, const Scene& scene,
                                                double cell) {
  std::map<std::array<int, 3>, double> field;
  double all = 0;
  simulation.visit_points([&](const PointState& p) {
    const double mass = scene.materials[p.material].density();
    all += mass;
    std::array<int, 3> at = {};
    std::array<double, 3> beyond = {};
    for (int a = 0; a < scene.dimension; ++a) {
      const double x = p.position[a] / cell;
      at[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(x));
      beyond[static_cast<std::size_t>(a)] = x - std::floor(x);
    }
    for (int corner = 0; corner < 1 << scene.dimension; ++corner) {
      std::array<int, 3> node = at;
      double share = mass;
      for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a) {
        const int up = corner >> a & 1;
        node[a] += up;
        share *= up != 0 ? beyond[a] : 1 - beyond[a];
      }
      field[node] += share;
    }
  });
  for (auto& [node, mass] : field) mass /= all;
  return field;
}

/// What share of the mass lies elsewhere in `b` than in `a`: half the sum of all differences, 0 … 1.
double displaced(const std::map<std::array<int, 3>, double>& a,
                 const std::map<std::array<int, 3>, double>& b) {
  double sum = 0;
  for (const auto& [node, mass] : a) {
    const auto other = b.find(node);
    sum += std::abs(mass - (other == b.end() ? 0 : other->second));
  }
  for (const auto& [node, mass] : b)
    if (a.count(node) == 0) sum += mass;
  return 0.5 * sum;
}

/// Largest distance at the times that both have, over `length`.
double way(const Trace& run, const Trace& reference, const std::vector<Vec3> Trace::*of, double length) {
  double worst = 0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < run.t.size(); ++i) {
    const double near = 1e-6 * reference.t.back();
    while (j < reference.t.size() && reference.t[j] < run.t[i] - near) ++j;
    if (j == reference.t.size()) break;
    if (std::abs(reference.t[j] - run.t[i]) <= near)
      worst = std::max(worst, ((run.*of)[i] - (reference.*of)[j]).norm() / length);
  }
  return worst;
}

double tear_error(const Trace& run, const Trace& reference, double duration) {
  if ((run.torn_at < 0) != (reference.torn_at < 0)) return 1;
  return std::abs(run.torn_at - reference.torn_at) / duration;
}

class TraceWatch : public Watch {
 public:
  /// `cell`: of the density field, m. Without a reference it only keeps the trace.
  TraceWatch(const Scene& scene, double cell, std::shared_ptr<const Trace> reference)
      : scene_(scene), cell_(cell), reference_(std::move(reference)) {}

  void see(const Simulation& simulation) override {
    const FrameMeasure& m = simulation.report().frames.back();
    trace_.t.push_back(m.time);
    trace_.center.push_back(m.center_of_mass);
    trace_.lowest.push_back(m.lowest);
    trace_.highest.push_back(m.highest);
    if (m.weak_fraction > 0 && trace_.torn_at < 0) trace_.torn_at = m.time;
    if (m.frame == scene_.last_frame()) trace_.field = mass_field(simulation, scene_, cell_);
  }

  [[nodiscard]] std::vector<Measure> measures() const override {
    const Trace& r = *reference_;
    const double length = (r.highest.front() - r.lowest.front()).norm();
    std::vector<Measure> all = {
        {"centre of mass", way(trace_, r, &Trace::center, length)},
        {"front", std::max(way(trace_, r, &Trace::lowest, length), way(trace_, r, &Trace::highest, length))},
        {"density field", displaced(trace_.field, r.field)}};
    if (trace_.torn_at >= 0 || r.torn_at >= 0)
      all.push_back({"tear time", tear_error(trace_, r, scene_.duration)});
    return all;
  }

  [[nodiscard]] const Trace& trace() const { return trace_; }

 private:
  Scene scene_;
  double cell_;
  std::shared_ptr<const Trace> reference_;
  Trace trace_;
};

}  // namespace

Settings finest_settings(const Scene& scene) {
  const Knob& spacing = knob_named("spacing");
  const Knob& precision = knob_named("precision");
  const Knob& safety = knob_named("safety-factor");
  return {{spacing.name, spacing.pointer, spacing.turn, 0.5},
          {precision.name, precision.pointer, precision.turn, "double"},
          {safety.name, safety.pointer, safety.turn, 0.5 * scene.numerics.safety_factor}};
}

Subject scene_subject(const Scene& scene, int threads) {
  const double cell = 2 * scene.spacing;
  const Scene finest = with_settings(scene, finest_settings(scene));
  TraceWatch watch(finest, cell, nullptr);
  const auto simulation = Simulation::create(make_plan(finest), threads);
  for (int i = 0; i <= finest.last_frame(); ++i) {
    run_to(*simulation, i);
    watch.see(*simulation);
  }
  const auto reference = std::make_shared<const Trace>(watch.trace());
  Subject subject;
  subject.name = scene.name;
  subject.error_of = "the largest of: centre of mass, front, density field, tear time; from the finest run";
  subject.scene = [scene](const Settings& settings) { return with_settings(scene, settings); };
  subject.watch = [cell, reference](const Scene& changed) -> std::unique_ptr<Watch> {
    return std::make_unique<TraceWatch>(changed, cell, reference);
  };
  return subject;
}

}  // namespace lather::study
