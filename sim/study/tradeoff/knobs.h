#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/scene/value.h"

/// What trades speed for accuracy, as a table: a knob is a pointer into scenes and the values to try there.
namespace lather::study {

/// What a knob's value does with the field at its pointer.
enum class Turn {
  kSet,     ///< takes its place; null takes the field away
  kScale,   ///< multiplies it
  kPerAxis  ///< n: n^dimension takes its place
};

struct Knob {
  std::string name;     ///< on the command line, e.g. "kernel"
  std::string pointer;  ///< into a scene that is written out, e.g. "/numerics/kernel"; "*": every element
  Turn turn = Turn::kSet;
  std::vector<Value> values;     ///< tried by default
  std::optional<Solver> solver;  ///< that it belongs to; none: both
  bool numerics = true;          ///< false: it changes what comes out, not how the motion is computed
};

inline constexpr const char* kSpacingPointer = "/spacing";
inline constexpr const char* kPointsPointer = "/points_per_cell";

/// All knobs.
[[nodiscard]] const std::vector<Knob>& knobs();

/// What a scene's "quality" sets, with the values that it picks from: numerics only.
[[nodiscard]] std::vector<Knob> quality_knobs(Solver solver);

/// The knob of that name. Throws InputError, with the nearest name, where there is none.
[[nodiscard]] const Knob& knob_named(const std::string& name);

/// One knob at one value.
struct Setting {
  std::string knob;
  std::string pointer;
  Turn turn = Turn::kSet;
  Value value;
};
/// Several; none: the scene as it is.
using Settings = std::vector<Setting>;

/// "kernel = quadratic, safety-factor = 0.2"; "as it is" for none.
[[nodiscard]] std::string to_text(const Settings& settings);
/// {"kernel": "quadratic", "safety-factor": 0.2}
[[nodiscard]] Object to_json(const Settings& settings);

/// The number that a setting scales by, or has along an axis. Throws InputError where it is none above 0.
[[nodiscard]] double factor_of(const Setting& setting);

/// Whether the scene has what the knob turns.
[[nodiscard]] bool turns(const Knob& knob, const Scene& scene);

/// The setting of the knob with that pointer, null where there is none.
[[nodiscard]] const Setting* setting_at(const Settings& settings, const std::string& pointer);

/// The scene with the settings made, read anew and so checked as any scene file is. Throws InputError where
/// it is none then.
[[nodiscard]] Scene with_settings(const Scene& scene, const Settings& settings);

/// Reads "kernel" (with the knob's own values) or "safety-factor=0.1,0.2" (a value that is no JSON is text).
/// Throws InputError.
[[nodiscard]] Knob read_knob(const std::string& text);

/// The scene as it is, and each knob turned alone to each of its values.
[[nodiscard]] std::vector<Settings> one_at_a_time(const std::vector<Knob>& of);
/// Every combination of the knobs' values.
[[nodiscard]] std::vector<Settings> product(const std::vector<Knob>& of);

}  // namespace lather::study
