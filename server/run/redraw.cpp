#include "server/run/redraw.h"

#include <algorithm>
#include <chrono>

#include "render/render.h"
#include "server/artifacts/safe_read.h"
#include "server/artifacts/whole_file.h"
#include "server/run/render_thread.h"
#include "server/run/serial_events.h"
#include "sim/export/kept_frame.h"
#include "sim/simulation.h"
#include "sim/surface/skin.h"

namespace lather::server {
namespace {

constexpr std::size_t kLargestFile = std::size_t{4} << 30;

bool is_below(const std::string& pointer, const std::string& key) {
  return pointer == key || pointer.compare(0, key.size() + 1, key + '/') == 0;
}

/// The kept frames of one run.
class Kept {
 public:
  Kept(const Scene& scene, std::vector<std::filesystem::path> particles, const RunSettings& settings)
      : scene_(scene), scenery_(scene), particles_(std::move(particles)), settings_(settings) {}

  /// The indices in `range` that are there, in order.
  [[nodiscard]] std::vector<int> indices(const FrameRange& range) const {
    std::vector<int> found;
    for (int index = std::max(0, range.first); index <= std::min(range.last, scene_.last_frame()); ++index)
      if (directory_of(frame_file_name(index, "ply"))) found.push_back(index);
    if (found.empty())
      throw InputError(
          {{"", "", "files 00000.ply ... in this range of frames",
            "No particles are kept there: run the scene with --set '/output/particles=[\"ply\"]'."}});
    return found;
  }

  [[nodiscard]] Frame read(int index) const {
    const std::string name = frame_file_name(index, "ply");
    const std::filesystem::path* const directory = directory_of(name);
    const std::optional<std::string> bytes =
        directory ? read_beneath(*directory, name, kLargestFile) : std::nullopt;
    if (!bytes) throw std::runtime_error("the particles " + name + " are not there or cannot be read");
    try {
      return read_kept_frame(*bytes, scenery_);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error("the particles " + name + ": " + error.what());
    }
  }

  /// With what the look and the output ask for beside the points.
  [[nodiscard]] Frame whole(int index) const {
    Frame frame = read(index);
    const bool files = !settings_.files.empty() && !scene_.output.skin.empty();
    if (files || scene_.look.style == "skin") frame.skins = skins_of(frame, settings_.threads);
    return frame;
  }

 private:
  /// Null where none has it.
  [[nodiscard]] const std::filesystem::path* directory_of(const std::string& name) const {
    for (const std::filesystem::path& directory : particles_)
      if (open_beneath(directory, name)) return &directory;
    return nullptr;
  }

  const Scene& scene_;
  const Scenery scenery_;
  const std::vector<std::filesystem::path> particles_;
  const RunSettings settings_;
};

/// A run frames its automatic camera by frame 0, whichever frames are drawn again.
Scene with_camera(Scene scene, const Kept& kept) {
  if (scene.look.camera.automatic && scene.dimension == 3)
    scene.look.camera = render::automatic_camera(scene.look, scene.output, kept.read(0));
  return scene;
}

RunProgress progress_at(std::size_t done, const std::vector<int>& indices, double seconds) {
  RunProgress progress;
  const auto all = static_cast<double>(indices.size());
  progress.frame = indices[std::min(done, indices.size() - 1)];
  progress.frames = indices.back() + 1;
  progress.fraction = static_cast<double>(done) / all;
  if (done > 0) {
    progress.seconds_per_frame = seconds / static_cast<double>(done);
    progress.eta_seconds = progress.seconds_per_frame * (all - static_cast<double>(done));
  }
  return progress;
}

}  // namespace

void check_redrawn(const std::vector<Override>& overrides) {
  std::vector<Problem> problems;
  for (const Override& change : overrides)
    if (!is_below(change.pointer, "/look") && !is_below(change.pointer, "/output"))
      problems.push_back(
          {change.pointer, change.json, "a pointer to /look or /output, or below them",
           "Drawing again changes the look and the output alone; run the scene again for the rest."});
  if (!problems.empty()) throw InputError(std::move(problems));
}

bool asks_for_files(const std::vector<Override>& overrides) {
  return std::any_of(overrides.begin(), overrides.end(), [](const Override& change) {
    return change.pointer == "/output" || is_below(change.pointer, "/output/particles") ||
           is_below(change.pointer, "/output/skin");
  });
}

Report redraw(const Scene& scene, const std::vector<std::filesystem::path>& particles,
              const FrameRange& range, const RunSettings& settings, RunEvents& events,
              const std::atomic<Stop>& stop) {
  using Clock = std::chrono::steady_clock;
  SerialEvents serial(events);
  RunSettings with_threads = settings;
  with_threads.threads = thread_count(settings.threads);
  const Kept kept(scene, particles, with_threads);
  const std::vector<int> indices = kept.indices(range);
  const Scene drawn = with_camera(scene, kept);
  RenderThread renderer(drawn, scene, with_threads, serial);
  serial.log("drawing with " + renderer.backend());
  const auto start = Clock::now();
  std::size_t done = 0;
  while (done < indices.size() && stop.load() == Stop::kNo && renderer.push(kept.whole(indices[done]))) {
    ++done;
    serial.progress(progress_at(done, indices, std::chrono::duration<double>(Clock::now() - start).count()));
  }
  const Stop asked = done == indices.size() ? Stop::kNo : stop.load();
  renderer.finish(asked == Stop::kNo);

  Report report;
  report.state = asked == Stop::kNo ? "succeeded" : asked == Stop::kNow ? "cancelled" : "paused";
  report.scene_name = scene.name;
  report.scene_hash = scene_hash(scene);
  report.version = version();
  report.render_backend = renderer.backend();
  report.render_seconds = renderer.seconds();
  report.threads = with_threads.threads;
  write_whole(settings.report, to_json(report));
  return report;
}

}  // namespace lather::server
