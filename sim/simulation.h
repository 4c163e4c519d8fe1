#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include "sim/frame.h"
#include "sim/plan/plan.h"
#include "sim/report/report.h"

/// The one door to the physics: create(Plan) -> step to frame -> Frame -> Report; save, restore.
///
/// One thread owns a Simulation; it uses `threads` threads inside a step. Results do not depend on their
/// number.
namespace lather {

struct Progress {
  int frame = 0;         ///< the frame being worked towards
  double time = 0;       ///< s, simulated
  double time_step = 0;  ///< s, of the last step
  std::uint64_t step = 0;
};

/// One point of the present state for those who measure, in double precision whatever the run's.
struct PointState {
  std::uint32_t id = 0;
  std::uint32_t material = 0;         ///< index into Scene::materials
  Vec3 position = Vec3::Zero();       ///< m; periodic axes wrapped when last sorted
  Vec3 velocity = Vec3::Zero();       ///< m/s
  std::array<double, 6> stress = {};  ///< Kirchhoff, xx yy zz xy xz yz, Pa
  double concentration = 0;           ///< c of a material that carries one, dimensionless; else 0
};

class Simulation {
 public:
  /// `threads` = 0 takes all cores. Throws InputError when the machine lacks the plan's kernel level.
  [[nodiscard]] static std::unique_ptr<Simulation> create(const Plan& plan, int threads = 0);
  virtual ~Simulation() = default;

  /// Steps on to frame `index` (0 … last; 0 is the initial state). Calls `heartbeat` after every step; when
  /// that returns false it stops there and returns false, in a state from which it can go on. Throws
  /// SimulationError when the state is no longer finite or runs away.
  virtual bool step_to_frame(int index, const std::function<bool(const Progress&)>& heartbeat) = 0;

  [[nodiscard]] virtual Frame frame() const = 0;           ///< snapshot of the present state
  [[nodiscard]] virtual const Report& report() const = 0;  ///< of all steps so far

  /// Every point of the present state, in an order that no number of threads changes.
  virtual void visit_points(const std::function<void(const PointState&)>& visit) const = 0;

  /// The whole state as bytes, and back; bit-equal onwards. A plan that differs in its scene's duration alone
  /// takes them, too. Throws InputError for another plan's or version's bytes, and is of no use then.
  [[nodiscard]] virtual std::string save() const = 0;
  virtual void restore(const std::string& bytes) = 0;
};

/// The version of this build, e.g. "0.1.0".
[[nodiscard]] const char* version();

}  // namespace lather
