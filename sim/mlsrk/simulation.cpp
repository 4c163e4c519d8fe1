#include "sim/mlsrk/simulation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/checkpoint_bytes.h"
#include "sim/frame_loop.h"
#include "sim/mlsrk/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/step_bound.h"
#include "sim/report/measure.h"
#include "sim/report/pieces.h"
#include "sim/snapshot.h"

namespace lather::mlsrk {
namespace {

template <class Real>
class MlsrkSimulation final : public FrameLoop {
 public:
  MlsrkSimulation(const Plan& plan, int threads)
      : FrameLoop(plan, threads), model_(plan), stepper_(model_, threads), snapshot_(plan.scene) {
    const Scene& scene = plan.scene;
    for (const Material& m : scene.materials)
      state_.sets.emplace_back(scene.dimension, planned_fields(scene, m), scene.domain.box.min,
                               scene.spacing);
    state_.left.resize(scene.materials.size());
    seed_points(scene, [&](const Seed& s) {
      ParticleSet<Real>& set = state_.sets[s.material];
      const PointSlot at = set.add(s.position, s.velocity, s.velocity_gradient, s.id);
      if (const std::optional<Phase>& phase = scene.materials[s.material].phase)
        set.template values<double>(at.tile, Field::kConcentration)[at.lane] = phase->concentration;
      if (set.layout().has(Field::kGrip))
        set.template values<std::uint32_t>(at.tile, Field::kGrip)[at.lane] = s.grip;
      state_.max_speed = std::max(state_.max_speed, s.velocity.norm());
    });
    record(0);
  }

  [[nodiscard]] Frame frame() const override {
    return with_skins(snapshot_.take(state_.sets, state_.time, plan_, measured_frame_));
  }

  void visit_points(const std::function<void(const PointState&)>& visit) const override {
    for (std::size_t m = 0; m < state_.sets.size(); ++m) {
      ParticleSet<Real> set = state_.sets[m];  // kernels take tiles that they may change
      for (std::size_t t = 0; t < set.tiles(); ++t) {
        Real rows[kTile * kStressReals];
        model_.laws[m].stress({set.tile(t), &set.layout(), &model_.materials[m]}, rows);
        for (int lane = 0; lane < kTile; ++lane) {
          PointState point;
          point.id = set.template values<std::uint32_t>(t, Field::kId)[lane];
          if (point.id == kNoPoint) continue;
          point.material = static_cast<std::uint32_t>(m);
          point.position = set.position(t, lane);
          point.velocity = set.velocity(t, lane);
          for (std::size_t c = 0; c < 6; ++c)
            point.stress[c] = static_cast<double>(rows[static_cast<std::size_t>(lane) * kStressReals + c]) /
                              static_cast<double>(model_.materials[m].volume);
          if (set.layout().has(Field::kConcentration))
            point.concentration = set.template values<double>(t, Field::kConcentration)[lane];
          visit(point);
        }
      }
    }
  }

  [[nodiscard]] std::string save() const override {
    checkpoint::Writer w(checkpoint_key());
    w.put(measured_frame_);
    for_state(state_, [&](const auto& value) { w.put(value); });
    w.put_report(report_);
    for (const auto& set : state_.sets) set.save(w.bytes);
    return std::move(w.bytes);
  }
  void restore(const std::string& bytes) override {
    checkpoint::Reader r(bytes, checkpoint_key());
    r.get(measured_frame_);
    for_state(state_, [&](auto& value) { r.get(value); });
    r.get_report(report_);
    r.get_sets(state_.sets);
    stepper_.forget_tiles();
    forget_skins();
  }

 private:
  template <class AnyState, class Visit>
  static void for_state(AnyState& s, const Visit& visit) {
    visit(s.step), visit(s.time), visit(s.drift), visit(s.sorted);
    visit(s.max_speed), visit(s.max_acceleration), visit(s.stiffest);
    visit(s.regularized), visit(s.light);
    for (auto& left : s.left) visit(left.points), visit(left.shares);
  }

  [[nodiscard]] Moment moment() const override { return {state_.time, state_.step}; }
  void set_time(double time) override { state_.time = time; }
  [[nodiscard]] const StageClock& clock() const override { return stepper_.clock(); }
  StepExtremes take_step(double dt) override { return stepper_.step(state_, dt); }

  [[nodiscard]] std::uint64_t point_count() const override {
    std::uint64_t n = 0;
    for (const auto& set : state_.sets) n += set.size();
    return n;
  }

  /// The planned step, or a shorter one while moduli are hardened, points fast or forces large.
  [[nodiscard]] double step_limit() const override {
    const Scene& s = plan_.scene;
    const double planned = planned_step(s, plan_.step_bound);
    if (s.numerics.time_step > 0) return planned;
    constexpr double kMostSpacings = 0.2;  // that a point moves in an automatic step
    constexpr double kFall = 0.25;         // of the time in which the largest acceleration covers a spacing
    double limit =
        std::min(planned, s.numerics.safety_factor * plan_.step_bound / std::sqrt(state_.stiffest));
    double speed = state_.max_speed;
    if (!s.grips.empty()) speed = std::max(speed, stepper_.grips().fastest(state_.time, limit));
    if (speed > 0) limit = std::min(limit, kMostSpacings * s.spacing / speed);
    if (state_.max_acceleration > 0)
      limit = std::min(limit, kFall * std::sqrt(s.spacing / state_.max_acceleration));
    return limit;
  }

  FrameMeasure measure_state(int index) override {
    stepper_.sort_when_drifted(state_);
    FrameMeasure m = measure_points(plan_.scene, state_.sets, threads_);
    m.lumped = stepper_.measure_lumped(state_);
    // Points a spacing apart leave cells of one spacing empty; pieces lie out of each other's reach.
    find_pieces(state_.sets, model_.bounds, 2).put(m);
    for (std::size_t s = 0; s < state_.sets.size(); ++s) {
      m.points_left += state_.left[s].points;
      m.mass_left +=
          model_.scene.materials[s].density() * model_.scene.point_volume() * state_.left[s].shares;
    }
    if (plan_.scene.wants_skin()) measure_skins(snapshot_.take(state_.sets, state_.time, plan_, index), m);
    report_.regularized_moments = state_.regularized;
    report_.light_masses = state_.light;
    return m;
  }

  Model<Real> model_;
  State<Real> state_;
  Stepper<Real> stepper_;
  Snapshot snapshot_;
};

}  // namespace

std::unique_ptr<Simulation> create_simulation(const Plan& plan, int threads) {
  if (plan.scene.numerics.precision == Precision::kDouble)
    return std::make_unique<MlsrkSimulation<double>>(plan, threads);
  return std::make_unique<MlsrkSimulation<float>>(plan, threads);
}

}  // namespace lather::mlsrk
