#include <array>
#include <cstdio>
#include <fstream>

#include "server/command/commands.h"
#include "sim/study/soak/soak.h"

namespace lather::server {
namespace {

using study::Outcome;

/// The scene as a file that `lather run` takes, and its mesh beside it.
void keep(const std::filesystem::path& directory, const std::string& name, const std::string& document) {
  std::filesystem::create_directories(directory);
  std::ofstream(directory / (name + ".json")) << document << '\n';
  std::ofstream(directory / "mesh.obj") << study::random_scene_mesh();
}

void print_broken(std::uint64_t index, const study::Soaked& soaked, const std::string& name) {
  std::fprintf(stderr, "scene %llu: %s\n", static_cast<unsigned long long>(index),
               soaked.verdict.why.c_str());
  std::fprintf(stderr, "%s\n", name.empty() ? soaked.scene.document.c_str() : name.c_str());
}

}  // namespace

int soak_command(const SoakOptions& options) {
  std::array<std::uint64_t, 4> counts = {};
  std::uint64_t steps = 0;
  for (std::uint64_t i = options.first; i < options.first + options.scenes; ++i) {
    const study::Soaked soaked = study::soak(options.seed, i, options.most_steps);
    ++counts[static_cast<std::size_t>(soaked.verdict.outcome)];
    steps += soaked.verdict.steps;
    if (soaked.verdict.outcome != Outcome::kBroken) continue;
    const std::string name = "soak-" + std::to_string(options.seed) + "-" + std::to_string(i);
    if (!options.keep.empty()) keep(options.keep, name, soaked.scene.document);
    print_broken(i, soaked,
                 options.keep.empty() ? std::string() : (options.keep / (name + ".json")).string());
  }
  const auto of = [&](Outcome outcome) {
    return static_cast<unsigned long long>(counts[static_cast<std::size_t>(outcome)]);
  };
  if (options.json)
    std::printf(
        R"({"scenes": %llu, "seed": %llu, "steps": %llu, "held": %llu, "stopped": %llu, "broken": %llu})"
        "\n",
        static_cast<unsigned long long>(options.scenes), static_cast<unsigned long long>(options.seed),
        static_cast<unsigned long long>(steps), of(Outcome::kHeld), of(Outcome::kStopped),
        of(Outcome::kBroken));
  else
    std::printf("%llu scenes, %llu steps: %llu held, %llu stopped with an error, %llu broken\n",
                static_cast<unsigned long long>(options.scenes), static_cast<unsigned long long>(steps),
                of(Outcome::kHeld), of(Outcome::kStopped), of(Outcome::kBroken));
  return of(Outcome::kBroken) == 0 ? 0 : 1;
}

}  // namespace lather::server
