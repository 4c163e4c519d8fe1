// A Newtonian liquid shears in a periodic box: v_x = A sin(k y), k = 2 pi/L, fades as exp(-nu k^2 t) (Navier
// and Stokes), and with all that the numerics add to nu. The other solutions are those of sim/study/verify.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "sim/study/tradeoff/subject.h"
#include "sim/study/verify/couette.h"
#include "sim/study/verify/film.h"
#include "sim/study/verify/mlsrk/cases.h"
#include "sim/study/verify/oscillation.h"
#include "sim/study/verify/standing_wave.h"

namespace lather::study {
namespace {

constexpr double kWaveNumber = 2 * std::numbers::pi;

/// One number a frame.
struct Series {
  std::vector<double> t;  ///< s
  std::vector<double> x;
};

using Sample = std::function<double(const Simulation&, const Scene&)>;
using Judge = std::function<double(const Series&)>;

class SeriesWatch : public Watch {
 public:
  SeriesWatch(std::string what, Scene scene, Sample sample, Judge judge)
      : what_(std::move(what)),
        scene_(std::move(scene)),
        sample_(std::move(sample)),
        judge_(std::move(judge)) {}

  void see(const Simulation& simulation) override {
    series_.t.push_back(simulation.report().simulated_time);
    series_.x.push_back(sample_(simulation, scene_));
  }
  [[nodiscard]] std::vector<Measure> measures() const override { return {{what_, judge_(series_)}}; }

 private:
  std::string what_;
  Scene scene_;
  Sample sample_;
  Judge judge_;
  Series series_;
};

class ColumnWatch : public Watch {
 public:
  ColumnWatch(std::string what, const Scene& scene) : what_(std::move(what)), profile_(scene) {}
  void see(const Simulation& simulation) override { profile_.see(simulation); }
  [[nodiscard]] std::vector<Measure> measures() const override { return {{what_, profile_.error().mean}}; }

 private:
  std::string what_;
  mlsrk::ColumnProfile profile_;
};

/// Root of the mean square of x(t) over x(0) less `exact`(t), without the first frame, which is given.
template <class Exact>
Judge shape_error(const Exact& exact) {
  return [exact](const Series& s) {
    double sum = 0;
    for (std::size_t i = 1; i < s.x.size(); ++i) sum += std::pow(s.x[i] / s.x[0] - exact(s.t[i]), 2);
    return std::sqrt(sum / static_cast<double>(s.x.size() - 1));
  };
}

auto series(const Sample& sample, const Judge& judge) {
  return [sample, judge](const std::string& error_of, const Scene& scene) -> std::unique_ptr<Watch> {
    return std::make_unique<SeriesWatch>(error_of, scene, sample, judge);
  };
}

/// How an exact case makes its scene: at a spacing over its usual one, with so many points to a cell where
/// that may be chosen.
using Build = std::function<Scene(double spacing, int points_per_cell)>;

struct Exact {
  std::string name;
  std::string error_of;
  Build build;
  std::function<std::unique_ptr<Watch>(const std::string& error_of, const Scene&)> watch;
  bool resolves = true;  ///< false: exact at any spacing, which follows from the step
};

/// The numerics that scenes have by default, with the blends that the papers have a step.
void make_plain(Scene& scene, double step) {
  const PhaseNumerics phases = scene.numerics.mlsrk.phases;
  scene.numerics = Numerics{};
  scene.numerics.mlsrk.phases = phases;
  scene.numerics.flip_blend_reference_step = step;
  scene.numerics.mlsrk.velocity_blend_reference_step = step;
}

/// The step that the case takes at its usual spacing with default numerics.
double usual_step(const Exact& exact, int points_per_cell) {
  Scene scene = exact.build(1, points_per_cell);
  make_plain(scene, 1);
  return make_plan(scene).time_step;
}

Scene exact_scene(const Exact& exact, const Settings& settings) {
  const Setting* spacing = setting_at(settings, kSpacingPointer);
  const Setting* points = setting_at(settings, kPointsPointer);
  if (spacing != nullptr && !exact.resolves)
    throw InputError({{kSpacingPointer, write_json(spacing->value), "no change in \"" + exact.name + "\"",
                       "Its flow is linear, which any spacing resolves."}});
  const Scene usual = exact.build(1, 0);
  const int per_cell =
      points != nullptr ? with_settings(usual, {*points}).points_per_cell : usual.points_per_cell;
  Scene scene = exact.build(spacing != nullptr ? factor_of(*spacing) : 1, per_cell);
  make_plain(scene, usual_step(exact, usual.points_per_cell));
  Settings rest;
  for (const Setting& s : settings)
    if (&s != spacing && &s != points) rest.push_back(s);
  return with_settings(scene, rest);
}

Subject subject_of(const Exact& exact) {
  Subject subject;
  subject.name = exact.name;
  subject.error_of = exact.error_of;
  subject.exact = true;
  subject.scene = [exact](const Settings& settings) { return exact_scene(exact, settings); };
  subject.watch = [exact](const Scene& scene) -> std::unique_ptr<Watch> {
    return exact.watch(exact.error_of, scene);
  };
  return subject;
}

int cells_of(int usual, double spacing) {
  return static_cast<int>(std::lround(usual / spacing));
}

int or_usual(int points_per_cell, int usual) {
  return points_per_cell > 0 ? points_per_cell : usual;
}

Judge last_value() {
  return [](const Series& s) { return s.x.back(); };
}

/// Of the points' distance: any flow disorders points, and a lattice would flatter short supports.
constexpr double kDisorder = 0.5;

// --- a Newtonian liquid ---

constexpr LiquidParameters kLiquid = {1000, 1.6e4, 7, {10, 0}};  // nu = 0.01 m^2/s; sound at 4 m/s
constexpr double kDecay =
    kLiquid.viscous.viscosity / kLiquid.density * kWaveNumber * kWaveNumber;  // nu k^2, 1/s

/// A wave so many cells long, over 1/(nu k^2). In 3D, and four cells (eight points) wide.
Scene viscous_wave(Solver solver, int cells, int points_per_cell) {
  const double h = 1.0 / cells;
  const double width = solver == Solver::kMpm ? 4 * h : 8 * h;
  Scene scene;
  scene.name = "shear wave in a liquid";
  scene.solver = solver;
  scene.domain.box = {Vec3::Zero(), Vec3(width, 1, width)};
  scene.domain.periodic = {true, true, true};
  scene.gravity = Vec3::Zero();
  scene.spacing = h;
  scene.points_per_cell = solver == Solver::kMpm ? or_usual(points_per_cell, 8) : 1;
  scene.materials.push_back(material_of(kLiquid));
  scene.jitter = kDisorder;
  add_layers(scene, scene.domain.box, 1,
             [](double y) { return Vec3(0.01 * std::sin(kWaveNumber * y), 0, 0); });
  set_frames(scene, 1 / kDecay, 4);
  return scene;
}

Judge viscous_decay() {
  return shape_error([](double t) { return std::exp(-kDecay * t); });
}

double amplitude_along_x(const Simulation& simulation, const Scene& /*scene*/) {
  return wave_amplitude(simulation, 0);
}
double amplitude_along_y(const Simulation& simulation, const Scene& /*scene*/) {
  return wave_amplitude(simulation, 1);
}

// --- waves ---

constexpr int kFramesPerPeriod = 10;

Judge standing(const Scene& wave, int periods) {
  const double frequency = periods * 2 * std::numbers::pi / wave.duration;
  return shape_error([frequency](double t) { return std::cos(frequency * t); });
}

// --- start-up of shear ---

constexpr int kReadings = 10;

Judge start_up_error() {
  return [](const Series& s) {
    double worst = 0;
    for (std::size_t i = 0; i < s.x.size(); ++i)
      worst = std::max(worst, std::abs(s.x[i] - exact_couette_stress(s.t[i])));
    return worst;
  };
}

const std::string kWaveError = "speeds over the first one less the exact wave, root of the mean square";
const std::string kStartUpError = "shear stress over the steady one, largest error over time";

/// Those of the grid.
void add_mpm(std::vector<Exact>& all) {
  all.push_back(
      {"film", "velocity profile over the plug's speed, root of the mean square",
       [](double spacing, int n) { return flowing_film(cells_of(16, spacing), or_usual(n, 4)); },
       series([](const Simulation& s, const Scene& /*scene*/) { return film_error(s); }, last_value())});
  all.push_back(
      {"standing-wave", kWaveError,
       [](double spacing, int n) {
         return standing_wave(cells_of(48, spacing), kFramesPerPeriod, or_usual(n, 4));
       },
       series(amplitude_along_x, standing(standing_wave(8, kFramesPerPeriod), kStandingWavePeriods))});
  all.push_back({"viscous-wave", kWaveError,
                 [](double spacing, int n) { return viscous_wave(Solver::kMpm, cells_of(16, spacing), n); },
                 series(amplitude_along_y, viscous_decay())});
  all.push_back({"couette", kStartUpError,
                 [](double /*spacing*/, int n) {
                   Scene scene = couette(Solver::kMpm, kReadings);
                   scene.points_per_cell = or_usual(n, 8);
                   return scene;
                 },
                 series(couette_stress, start_up_error()), false});
}

/// Those of the particle method.
void add_mlsrk(std::vector<Exact>& all) {
  all.push_back(
      {"mlsrk-wave", kWaveError,
       [](double spacing, int /*n*/) {
         return mlsrk::standing_wave(cells_of(48, spacing), kFramesPerPeriod);
       },
       series(amplitude_along_x, standing(mlsrk::standing_wave(8, kFramesPerPeriod), mlsrk::kWavePeriods))});
  all.push_back(
      {"mlsrk-viscous-wave", kWaveError,
       [](double spacing, int /*n*/) { return viscous_wave(Solver::kMlsrk, cells_of(12, spacing), 1); },
       series(amplitude_along_y, viscous_decay())});
  all.push_back({"mlsrk-disk", "angular momentum over the first, less 1, root of the mean square",
                 [](double spacing, int /*n*/) {
                   Scene scene = mlsrk::rotating_disk(cells_of(16, spacing));
                   scene.jitter = kDisorder;
                   return scene;
                 },
                 series([](const Simulation& s,
                           const Scene& /*scene*/) { return s.report().frames.back().angular_momentum.z(); },
                        shape_error([](double /*t*/) { return 1.0; }))});
  all.push_back(
      {"mlsrk-column", "pressure of a liquid at rest over that at the floor, root of the mean square",
       [](double spacing, int /*n*/) { return mlsrk::column(cells_of(24, spacing), kDisorder, true); },
       [](const std::string& error_of, const Scene& scene) -> std::unique_ptr<Watch> {
         return std::make_unique<ColumnWatch>(error_of, scene);
       }});
  all.push_back({"mlsrk-couette", kStartUpError,
                 [](double /*spacing*/, int /*n*/) { return couette(Solver::kMlsrk, kReadings); },
                 series(couette_stress, start_up_error()), false});
  all.push_back(
      {"mlsrk-diffusion", "concentration wave over the first one, less the exact decay",
       [](double spacing, int /*n*/) { return mlsrk::concentration_wave(cells_of(48, spacing)); },
       series([](const Simulation& s, const Scene& /*scene*/) { return mlsrk::concentration_amplitude(s); },
              shape_error([end = mlsrk::concentration_wave(8).duration](double t) {
                return std::exp(-0.1 * t / end);
              }))});
}

}  // namespace

const std::vector<Subject>& exact_subjects() {
  static const std::vector<Subject> subjects = [] {
    std::vector<Exact> all;
    add_mpm(all);
    add_mlsrk(all);
    std::vector<Subject> out;
    for (const Exact& exact : all) out.push_back(subject_of(exact));
    return out;
  }();
  return subjects;
}

}  // namespace lather::study
