#include "sim/mpm/simulation.h"

#include <algorithm>
#include <cmath>

#include "sim/frame_loop.h"
#include "sim/mpm/checkpoint.h"
#include "sim/mpm/density.h"
#include "sim/mpm/levels.h"
#include "sim/mpm/point_states.h"
#include "sim/mpm/probes.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/step_bound.h"
#include "sim/report/measure.h"
#include "sim/report/pieces.h"
#include "sim/snapshot.h"

namespace lather::mpm {
namespace {

template <class Real>
class MpmSimulation final : public FrameLoop {
 public:
  MpmSimulation(const Plan& plan, int threads)
      : FrameLoop(plan, threads), model_(plan), stepper_(model_, threads), snapshot_(plan.scene) {
    const Scene& scene = plan.scene;
    for (const Material& m : scene.materials)
      state_.sets.emplace_back(scene.dimension, planned_fields(scene, m), scene.domain.box.min,
                               scene.spacing);
    state_.since_recovery.assign(scene.materials.size(), 0);
    seed_points(scene, [&](const Seed& s) {
      state_.sets[s.material].add(s.position, s.velocity, s.velocity_gradient, s.id);
      state_.max_speed = std::max(state_.max_speed, s.velocity.norm());
      state_.next_id = s.id + 1;
    });
    state_.emitters.resize(scene.emitters.size());
    state_.points_emitted.assign(scene.materials.size(), 0);
    state_.left.resize(scene.materials.size());
    state_.probes = first_probe_states(scene);
    report_.probes = empty_probe_series(scene);
    record(0);
    sample_probes(state_, model_, threads_, report_.probes);
  }

  [[nodiscard]] Frame frame() const override {
    return with_skins(snapshot_.take(state_.sets, state_.time, plan_, measured_frame_));
  }
  void visit_points(const std::function<void(const PointState&)>& visit) const override {
    visit_states(state_, model_, visit);
  }

  [[nodiscard]] std::string save() const override {
    return write_checkpoint(state_, report_, measured_frame_, checkpoint_key());
  }
  void restore(const std::string& bytes) override {
    read_checkpoint(bytes, checkpoint_key(), state_, report_, measured_frame_);
    stepper_.forget_grid();
    forget_skins();
  }

 private:
  [[nodiscard]] Moment moment() const override { return {state_.time, state_.step}; }
  void set_time(double time) override { state_.time = time; }
  void before_step() override { stepper_.emit(state_); }
  void after_step() override { sample_probes(state_, model_, threads_, report_.probes); }
  [[nodiscard]] const StageClock& clock() const override { return stepper_.clock(); }

  /// The step of this moment: the planned one, shorter while moduli are hardened or points fast.
  [[nodiscard]] double step_limit() const override {
    const Scene& s = plan_.scene;
    const double planned = planned_step(s, plan_.step_bound / std::sqrt(state_.stiffest));
    if (s.numerics.time_step > 0 || state_.max_speed == 0) return planned;
    constexpr double kMostCells = 0.3;  // a point moves at most this far in an automatic step
    return std::min(planned, kMostCells * s.spacing / state_.max_speed);
  }

  StepExtremes take_step(double dt) override {
    const StepResult seen = stepper_.step(state_, dt);
    if (plan_.scene.numerics.integration == Integration::kSemiImplicit) count_solve(seen.solve);
    return seen.extremes;
  }

  [[nodiscard]] std::string advice(double dt) const override {
    const Numerics& n = plan_.scene.numerics;
    if (n.time_step > 0 || n.integration == Integration::kExplicit) return FrameLoop::advice(dt);
    return "Lower /numerics/implicit_step_factor from " + with_unit(n.implicit_step_factor, "") + ".";
  }

  /// A run whose solver stops early goes on: what is left of the residual acts like a small force, and
  /// a state that it spoils is found by check().
  [[nodiscard]] std::string unconverged_warning() const {
    const SolverTotals& s = report_.solver;
    return std::to_string(s.unconverged) + " of " + std::to_string(s.solves) +
           " semi-implicit steps stopped at /numerics/solver_iterations (" +
           std::to_string(plan_.scene.numerics.solver_iterations) +
           ") before /numerics/solver_tolerance was met; raise the one, or take shorter steps.";
  }

  void count_solve(const SolveFigures& solve) {
    SolverTotals& s = report_.solver;
    ++s.solves;
    s.iterations += static_cast<std::uint64_t>(solve.iterations);
    s.most_iterations = std::max(s.most_iterations, solve.iterations);
    s.unconverged += solve.converged ? 0 : 1;
    s.convex += solve.convex ? 1 : 0;
  }

  /// What came in and went out since the start.
  void report_flows(FrameMeasure& m) {
    for (std::size_t s = 0; s < state_.sets.size(); ++s) {
      const double mass = model_.scene.materials[s].density() * model_.scene.point_volume();
      m.points_emitted += state_.points_emitted[s];
      m.mass_emitted += mass * static_cast<double>(state_.points_emitted[s]);
      m.points_left += state_.left[s].points;
      m.mass_left += mass * state_.left[s].shares;
    }
    m.points_inserted = state_.resampled.inserted;
    m.points_merged = state_.resampled.merged;
    m.resampling_momentum = state_.resampled.momentum_change;
    m.points_removed = state_.removed.points;
    m.mass_removed = state_.removed.mass;
    report_.emitters.clear();
    for (std::size_t e = 0; e < state_.emitters.size(); ++e) {
      const EmitterState& own = state_.emitters[e];
      report_.emitters.push_back(
          {plan_.scene.emitters[e].name, own.releases, own.points, own.delayed, own.waited, own.waiting});
    }
  }

  [[nodiscard]] std::uint64_t point_count() const override {
    std::uint64_t n = 0;
    for (const auto& set : state_.sets) n += set.size();
    return n;
  }

  FrameMeasure measure_state(int index) override {
    stepper_.sort_when_drifted(state_);
    stepper_.detect_tearing(state_);
    FrameMeasure m = measure_points(plan_.scene, state_.sets, threads_);
    measure_density(stepper_, state_, model_, m);
    find_pieces(state_.sets, model_.bounds).put(m);
    if (const auto voids = stepper_.interior_voids(state_))
      m.interior_voids = static_cast<std::int64_t>(*voids);
    report_flows(m);
    if (plan_.scene.wants_skin()) measure_skins(snapshot_.take(state_.sets, state_.time, plan_, index), m);
    return m;
  }

  [[nodiscard]] std::vector<std::string> warnings() const override {
    std::vector<std::string> all = plan_.warnings;
    if (report_.solver.unconverged > 0) all.push_back(unconverged_warning());
    return all;
  }

  Model<Real> model_;
  State<Real> state_;
  Stepper<Real> stepper_;
  Snapshot snapshot_;
};

}  // namespace

std::unique_ptr<Simulation> create_simulation(const Plan& plan, int threads) {
  if (plan.scene.numerics.precision == Precision::kDouble)
    return std::make_unique<MpmSimulation<double>>(plan, threads);
  return std::make_unique<MpmSimulation<float>>(plan, threads);
}

}  // namespace lather::mpm
