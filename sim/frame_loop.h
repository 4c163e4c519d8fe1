#pragma once

#include <algorithm>
#include <cstdint>

#include "sim/plan/stages.h"
#include "sim/report/stage_clock.h"
#include "sim/simulation.h"

namespace lather {

/// What a step saw of the points.
struct StepExtremes {
  double largest_cells = 0;  ///< largest |v| dt / spacing of any point along an axis
  double max_speed = 0;      ///< m/s
  bool finite = true;        ///< of every velocity and deformation
  bool collapsed = false;    ///< some J <= 0
  bool carried_out = false;  ///< a grip takes some point through a closed face of the domain

  void include(const StepExtremes& other) {
    largest_cells = std::max(largest_cells, other.largest_cells);
    max_speed = std::max(max_speed, other.max_speed);
    finite = finite && other.finite;
    collapsed = collapsed || other.collapsed;
    carried_out = carried_out || other.carried_out;
  }
};

/// Phase of a step's rounding of positions (see move() in sim/particles/tile.h): multiples of the golden
/// ratio modulo 1, to 20 bits so that a float holds them below 1.
template <class Real>
[[nodiscard]] Real rounding_phase(std::uint64_t step) {
  return static_cast<Real>(static_cast<double>((step + 1) * 0x9e3779b97f4a7c15U >> 44U) * 0x1p-20);
}

/// What the simulations of both solvers share: steps that end on frames, checks of the state, the report's
/// head and totals.
class FrameLoop : public Simulation {
 public:
  bool step_to_frame(int index, const std::function<bool(const Progress&)>& heartbeat) final;
  [[nodiscard]] const Report& report() const final { return report_; }

 protected:
  FrameLoop(const Plan& plan, int threads);

  /// The clock of the state.
  struct Moment {
    double time = 0;         ///< s
    std::uint64_t step = 0;  ///< steps done
  };
  [[nodiscard]] virtual Moment moment() const = 0;
  virtual void set_time(double time) = 0;
  [[nodiscard]] virtual std::uint64_t point_count() const = 0;
  /// Called before each step's length is chosen.
  virtual void before_step() {}
  virtual void after_step() {}
  /// Longest step of this moment, s.
  [[nodiscard]] virtual double step_limit() const = 0;
  virtual StepExtremes take_step(double dt) = 0;
  /// Figures of the present state; frame, time and step are filled in by the caller.
  virtual FrameMeasure measure_state(int index) = 0;
  [[nodiscard]] virtual const StageClock& clock() const = 0;
  [[nodiscard]] virtual std::vector<std::string> warnings() const { return plan_.warnings; }
  /// What to change when a step of `dt` ended in an unsound state.
  [[nodiscard]] virtual std::string advice(double dt) const;

  /// Adds the present state to the report as frame `index`.
  void record(int index);
  /// Names the state that bytes of a checkpoint belong to.
  [[nodiscard]] std::string checkpoint_key() const;

  /// The frame with the skins that its scene asks for: those of the measured one where they are known.
  [[nodiscard]] Frame with_skins(Frame frame) const;
  /// Makes the skins of `frame`, which is about to be measured, and adds their volume to `m`.
  void measure_skins(const Frame& frame, FrameMeasure& m);
  /// After a restore: skins are made anew.
  void forget_skins() { skins_.clear(); }

  Plan plan_;
  int threads_;
  Report report_;
  int measured_frame_ = -1;

 private:
  void step(double dt);
  /// Totals of the report, of all steps so far.
  void add_up();
  void check(const StepExtremes& seen, const Moment& start, double dt) const;
  /// Throws where a frame has more energy than the scene allows.
  void check_energy(const FrameMeasure& m) const;

  std::vector<FrameSkin> skins_;  // of the measured frame; none where nobody asks, or after a restore
  double last_step_ = 0;
};

/// "1.2 m/s"
[[nodiscard]] std::string with_unit(double value, const char* unit);

}  // namespace lather
