#include "sim/study/soak/soak.h"

#include "sim/scene/scene.h"

namespace lather::study {
namespace {

/// What differs between a run and its twin, in words; "" if nothing does.
std::string difference(const Verdict& run, const Verdict& twin) {
  if (run.outcome != twin.outcome || run.why != twin.why)
    return std::string("it ") + to_string(twin.outcome) + " there: " + twin.why;
  for (std::size_t i = 0; i < run.fingerprints.size(); ++i)
    if (run.fingerprints[i] != twin.fingerprints.at(i)) return "other points at frame " + std::to_string(i);
  return {};
}

std::string reads_back_otherwise(const RandomScene& random) {
  const std::string written = to_json(random.scene);
  const Scene read = parse_scene(written, "", {}, [](const std::string&) { return random_scene_mesh(); });
  return to_json(read) == written ? std::string() : "written out, the scene reads back as another one";
}

}  // namespace

Soaked soak(std::uint64_t seed, std::uint64_t index, std::uint64_t most_steps) {
  Soaked soaked;
  soaked.scene = random_scene(seed, index, most_steps);
  const Scene& scene = soaked.scene.scene;
  soaked.verdict = examine(scene, {most_steps, 1, false});
  if (soaked.verdict.outcome == Outcome::kBroken) return soaked;
  std::string wrong = reads_back_otherwise(soaked.scene);
  if (wrong.empty()) {
    const std::string other = difference(soaked.verdict, examine(scene, {most_steps, 2, true}));
    if (!other.empty()) wrong = "with two threads, saved and restored at every frame: " + other;
  }
  if (!wrong.empty()) {
    soaked.verdict.outcome = Outcome::kBroken;
    soaked.verdict.why = wrong;
  }
  return soaked;
}

}  // namespace lather::study
