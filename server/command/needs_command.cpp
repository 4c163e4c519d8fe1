#include <cstdio>
#include <string>

#include "server/artifacts/whole_file.h"
#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "sim/error.h"
#include "sim/scene/value.h"
#include "sim/study/needs.h"

namespace lather::server {
namespace {

void print_needs(const std::string& name, const study::SceneNeeds& needs) {
  std::printf("%s\n", name.c_str());
  for (const PlannedMaterial& m : needs.materials) {
    std::printf("  %s, %d bytes a point:", m.name.c_str(), m.bytes_per_point);
    for (const PlannedField& f : m.fields) std::printf(" %s (%d)", f.name.c_str(), f.bytes);
    std::printf("\n");
  }
  std::printf("  stages:");
  for (const study::StageNeed& s : needs.stages) {
    std::printf(" %s", s.name.c_str());
    if (s.share) std::printf(" %.1f %%", 100 * *s.share);
    std::printf("%s", &s == &needs.stages.back() ? "\n\n" : ",");
  }
  std::fflush(stdout);
}

Object json_of(const std::string& name, const study::SceneNeeds& needs) {
  Array materials;
  for (const PlannedMaterial& m : needs.materials) {
    Array fields;
    for (const PlannedField& f : m.fields) fields.emplace_back(f.name);
    materials.emplace_back(Object{{"name", m.name},
                                  {"bytes_per_point", static_cast<std::int64_t>(m.bytes_per_point)},
                                  {"fields", std::move(fields)}});
  }
  Array stages;
  for (const study::StageNeed& s : needs.stages)
    stages.emplace_back(Object{{"name", s.name}, {"share", s.share ? Value(*s.share) : Value()}});
  return {{"name", name}, {"materials", std::move(materials)}, {"stages", std::move(stages)}};
}

}  // namespace

int needs_command(const ScenesOptions& options) {
  Array scenes;
  for (const std::filesystem::path& file : options.scenes) {
    const std::string name = file.stem().string();
    const Plan plan = make_plan(scene_of(options, file));
    const study::SceneNeeds needs = study::needs_of(plan, options.threads, options.seconds);
    print_needs(name, needs);
    scenes.emplace_back(json_of(name, needs));
  }
  if (!options.json.empty())
    write_whole(options.json, write_json(Object{{"scenes", std::move(scenes)}}, 1) + "\n");
  return 0;
}

}  // namespace lather::server
