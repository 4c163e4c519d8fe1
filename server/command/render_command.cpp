#include <charconv>
#include <cstdio>

#include "server/command/commands.h"
#include "server/command/run_events.h"
#include "server/command/scene_source.h"
#include "server/run/redraw.h"
#include "sim/plan/plan.h"

namespace lather::server {
namespace {

/// "12" or "12:40".
FrameRange read_range(const std::string& text) {
  FrameRange range;
  if (text.empty()) return range;
  const std::size_t colon = text.find(':');
  const auto read = [&](std::string_view word, int& out) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc{} && end == word.data() + word.size() && out >= 0;
  };
  const std::string_view all = text;
  bool good = read(all.substr(0, colon), range.first);
  range.last = range.first;
  if (colon != std::string::npos) good = read(all.substr(colon + 1), range.last) && good;
  if (!good || range.last < range.first)
    throw InputError(
        {{"", text, "N or FIRST:LAST", "--frames needs the number of a frame, or of the first and last."}});
  return range;
}

std::vector<Override> changes_of(const RenderOptions& options) {
  std::vector<Override> changes;
  if (!options.look.empty()) changes.push_back({"/look", read_text(options.look)});
  for (Override& change : read_overrides(options.set)) changes.push_back(std::move(change));
  check_redrawn(changes);
  return changes;
}

}  // namespace

int render_command(const RenderOptions& options) {
  const std::filesystem::path out = options.out;
  const FrameRange range = read_range(options.frames);
  const std::vector<Override> changes = changes_of(options);
  const Scene scene = read_plan_scene(read_text(options.kept / "plan.json"), changes);
  std::filesystem::create_directories(out);
  const RunSettings settings = {
      out / "frames",  out / "report.json",    out / "probes.csv",
      options.threads, options.render_backend, asks_for_files(changes) ? out : std::filesystem::path()};
  const std::atomic<Stop>& interrupted = heed_interrupts();
  const Report report = with_events(options.json, [&](RunEvents& events) {
    return redraw(scene, {options.kept / "particles"}, range, settings, events, interrupted);
  });
  if (report.state == "cancelled") {
    std::fprintf(stderr, "interrupted; the frames made so far are in %s\n", (out / "frames").c_str());
    return kExitInterrupted;
  }
  if (!options.json) std::printf("frames in %s\n", (out / "frames").c_str());
  return 0;
}

}  // namespace lather::server
