#include "sim/study/stability/invariants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>

#include "sim/plan/plan.h"
#include "sim/report/energy_balance.h"
#include "sim/simulation.h"

namespace lather::study {
namespace {

/// "the mass is 2 kg, not 1 kg" in the numbers' full length.
std::string differs(const char* what, double is, double expected, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof text, "%s is %.9g %s, not %.9g %s", what, is, unit, expected, unit);
  return text;
}

double epsilon(const Scene& scene) {
  return scene.numerics.precision == Precision::kFloat ? std::numeric_limits<float>::epsilon()
                                                       : std::numeric_limits<double>::epsilon();
}

std::string not_a_number(const FrameMeasure& m) {
  struct Figure {
    const char* name;
    double value;
  };
  const std::array<Figure, 14> figures = {{{"mass", m.mass},
                                           {"momentum", m.momentum.sum()},
                                           {"angular momentum", m.angular_momentum.sum()},
                                           {"centre of mass", m.center_of_mass.sum()},
                                           {"lowest point", m.lowest.sum()},
                                           {"highest point", m.highest.sum()},
                                           {"kinetic energy", m.kinetic_energy},
                                           {"elastic energy of volume", m.elastic_volume_energy},
                                           {"elastic energy of shear", m.elastic_shear_energy},
                                           {"gravity's energy", m.gravity_energy},
                                           {"largest speed", m.max_speed},
                                           {"least J", m.min_volume_ratio},
                                           {"largest J", m.max_volume_ratio},
                                           {"weak fraction", m.weak_fraction}}};
  for (const Figure& f : figures)
    if (!std::isfinite(f.value)) return std::string("the ") + f.name + " is not a number";
  return {};
}

std::string wrong_mass(const Scene& scene, const FrameMeasure& start, const FrameMeasure& now) {
  const double expected = start.mass + now.mass_emitted - now.mass_left - now.mass_removed;
  // Sums over points, in double precision; masses of points change in resampling only, each by half a unit in
  // the last place.
  const auto resampled = static_cast<double>(now.points_inserted + now.points_merged);
  const auto summed = static_cast<double>(start.points + now.points_emitted);
  const double share =
      epsilon(scene) * std::sqrt(resampled) + std::numeric_limits<double>::epsilon() * summed;
  const double rounding = share * (start.mass + now.mass_emitted);
  return std::abs(now.mass - expected) > rounding ? differs("the mass", now.mass, expected, "kg")
                                                  : std::string();
}

std::string outside(const Scene& scene, const FrameMeasure& now) {
  if (now.points == 0 || scene.domain.boundary == Boundary::kOpen) return {};
  for (int axis = 0; axis < scene.dimension; ++axis) {
    if (scene.domain.periodic[static_cast<std::size_t>(axis)]) continue;
    const Box3& box = scene.domain.box;
    const double rounding =
        epsilon(scene) * std::max({std::abs(box.min[axis]), std::abs(box.max[axis]), scene.spacing});
    if (now.lowest[axis] < box.min[axis] - rounding)
      return differs("the lowest coordinate of a point", now.lowest[axis], box.min[axis], "m or more");
    if (now.highest[axis] > box.max[axis] + rounding)
      return differs("the highest coordinate of a point", now.highest[axis], box.max[axis], "m or less");
  }
  return {};
}

std::string gained_energy(const Scene& scene, const FrameMeasure& start, const FrameMeasure& now) {
  if (is_driven(scene)) return {};
  const double was = total_energy(scene, start);
  const double is = total_energy(scene, now);
  const double allowed = std::max(0.1, scene.numerics.allowed_energy_gain);
  return is > (1 + allowed) * was + rounding_energy(scene, now) ? differs("the energy", is, was, "J or less")
                                                                : std::string();
}

}  // namespace

const char* to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kHeld:
      return "held";
    case Outcome::kRefused:
      return "refused";
    case Outcome::kStopped:
      return "stopped";
    case Outcome::kBroken:
      return "broken";
  }
  return "";
}

std::string unsoundness(const Scene& scene, const FrameMeasure& start, const FrameMeasure& now) {
  std::string wrong = not_a_number(now);
  if (wrong.empty()) wrong = wrong_mass(scene, start, now);
  if (wrong.empty()) wrong = outside(scene, now);
  if (wrong.empty()) wrong = gained_energy(scene, start, now);
  return wrong;
}

Verdict examine(const Scene& scene, const Examination& examination) {
  Verdict verdict;
  std::unique_ptr<Simulation> simulation;
  try {
    const Plan plan = make_plan(scene);
    simulation = Simulation::create(plan, examination.threads);
    for (int index = 0; index < plan.frames; ++index) {
      const bool arrived = simulation->step_to_frame(
          index, [&](const Progress& p) { return p.step < examination.most_steps; });
      verdict.steps = simulation->report().steps;
      if (!arrived) break;
      const std::vector<FrameMeasure>& frames = simulation->report().frames;
      verdict.fingerprints.push_back(frames.back().fingerprint);
      const std::string wrong = unsoundness(scene, frames.front(), frames.back());
      const double was = total_energy(scene, frames.front());
      if (was > 0)
        verdict.most_energy = std::max(verdict.most_energy, total_energy(scene, frames.back()) / was);
      if (!wrong.empty()) {
        verdict.outcome = Outcome::kBroken;
        verdict.why = "frame " + std::to_string(index) + ": " + wrong;
        break;
      }
      if (examination.resumed) {
        const std::string saved = simulation->save();
        simulation = Simulation::create(plan, examination.threads);
        simulation->restore(saved);
      }
    }
  } catch (const InputError& error) {
    verdict.outcome = Outcome::kRefused;
    verdict.why = error.what();
  } catch (const SimulationError& error) {
    verdict.outcome = Outcome::kStopped;
    verdict.steps = static_cast<std::uint64_t>(error.details().step);
    verdict.why = error.what();
  } catch (const std::exception& error) {
    verdict.outcome = Outcome::kBroken;
    verdict.why = error.what();
  }
  return verdict;
}

}  // namespace lather::study
