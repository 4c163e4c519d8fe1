#include <array>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include "render/context.h"
#include "render/legend.h"
#include "render/mesh_pass.h"
#include "render/point_colors.h"
#include "render/point_normals.h"
#include "render/point_pass.h"
#include "render/render.h"
#include "render/screen_passes.h"
#include "render/shot.h"
#include "sim/error.h"

namespace lather::render {
namespace {

constexpr int kLargestSide = 16384;  // px, drawn; OSMesa accepts more and draws nothing
constexpr std::int64_t kMostSamples = std::int64_t{1} << 26;  // of the geometry buffer, 12 bytes each
constexpr int kMostSupersampling = 8;

[[noreturn]] void refuse(const std::string& pointer, long long value, const std::string& allowed,
                         const std::string& message) {
  Problem problem;
  problem.pointer = pointer;
  problem.value = std::to_string(value);
  problem.allowed = allowed;
  problem.message = message;
  throw InputError({problem});
}

void check_size(const Output& output) {
  const int samples = output.supersampling;
  if (samples < 1 || samples > kMostSupersampling)
    refuse("/output/supersampling", samples, "1 to " + std::to_string(kMostSupersampling),
           "A picture cannot be drawn with this many samples per pixel and axis.");
  const std::string sides =
      "1 to " + std::to_string(kLargestSide / samples) + " px with supersampling " + std::to_string(samples);
  const std::string larger = "The picture is too large or empty; make it smaller or lower the supersampling.";
  if (output.width < 1 || output.width > kLargestSide / samples)
    refuse("/output/width", output.width, sides, larger);
  if (output.height < 1 || output.height > kLargestSide / samples)
    refuse("/output/height", output.height, sides, larger);
  const std::int64_t drawn = std::int64_t{1} * output.width * output.height * samples * samples;
  if (drawn > kMostSamples)
    refuse("/output", drawn, "width * height * supersampling^2 up to " + std::to_string(kMostSamples),
           larger);
}

/// The driver's own limits, of a context that is current.
void check_driver(const Gl& gl, const Output& output) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const int samples = output.supersampling;
  const int side = std::max(output.width, output.height);
  if (side > largest / samples)
    refuse(output.width >= output.height ? "/output/width" : "/output/height", side,
           "1 to " + std::to_string(largest / samples) + " px with this graphics driver",
           "The picture is too large for the graphics driver; make it smaller.");
}

/// A frame whose scene asked for no skin cannot be drawn as one.
void check_skins(const Frame& frame, const Look& look) {
  if (look.style != "skin" || !frame.skins.empty() || frame.points.size() == 0) return;
  throw std::runtime_error("Frame " + std::to_string(frame.index) + " carries no skin to draw.");
}

class GlRenderer final : public Renderer {
 public:
  GlRenderer(std::unique_ptr<Context> context, const Look& look, const Output& output)
      : context_(std::move(context)), look_(look), output_(output) {
    check_driver(context_->gl(), output);
    screen_.emplace(context_->gl(), output);
    points_.emplace(context_->gl());
    meshes_.emplace(context_->gl());
  }
  ~GlRenderer() override {
    context_->make_current();
    meshes_.reset();
    points_.reset();
    screen_.reset();
  }
  GlRenderer(const GlRenderer&) = delete;
  GlRenderer& operator=(const GlRenderer&) = delete;

  Image draw(const Frame& frame) override {
    check_finite(frame);
    check_skins(frame, look_);
    const PointColors colors = color_points(frame, look_);
    if (!camera_) camera_ = look_.camera.automatic ? automatic_camera(look_, output_, frame) : look_.camera;
    const Shot shot = make_shot(frame, look_, *camera_, static_cast<double>(output_.width) / output_.height);
    context_->make_current();
    Image image = draw_passes(frame, shot, colors);
    if (colors.scale && look_.legend) draw_legend(image, *colors.scale);
    return image;
  }

  std::string draw_png(const Frame& frame, const PngText& text) override {
    const Image image = draw(frame);
    start_clock();
    std::string png = encode_png(image, text);
    record("png");
    return png;
  }

  const std::string& backend() const override { return context_->description(); }
  const PassTimes& pass_times() const override { return pass_times_; }

 private:
  using Clock = std::chrono::steady_clock;

  Image draw_passes(const Frame& frame, const Shot& shot, const PointColors& colors) {
    pass_times_.clear();
    start_clock();
    const bool points = look_.style == "points";
    if (points)
      points_->upload(frame.points.position, colors.colors,
                      point_normals(frame.points.position, frame.point_radius));
    meshes_->upload(frame, look_);
    record("upload");
    screen_->begin_shadow();
    if (shot.shadows) {
      meshes_->draw_shadow(shot);
      if (points) points_->draw_shadow(shot, screen_->shadow_side());
    }
    record("shadow");
    screen_->begin_geometry();
    meshes_->draw(shot, frame, look_);
    if (points) points_->draw(shot, screen_->drawn_width(), screen_->drawn_height());
    record("geometry");
    screen_->occlude(shot);
    record("occlusion");
    screen_->composite(shot, look_);
    record("composite");
    Image image = screen_->read();
    if (const GLenum error = context_->gl().GetError(); error != GL_NO_ERROR)
      throw std::runtime_error("Frame " + std::to_string(frame.index) + " is not drawn: OpenGL error " +
                               std::to_string(error) + " of " + backend());
    record("read");
    return image;
  }

  void start_clock() { started_ = Clock::now(); }

  /// Waits for the driver, so that each pass answers for its own time; the passes depend on each other
  /// anyway.
  void record(const char* pass) {
    context_->gl().Finish();
    const auto now = Clock::now();
    pass_times_.emplace_back(pass, std::chrono::duration<double>(now - started_).count());
    started_ = now;
  }

  std::unique_ptr<Context> context_;
  Look look_;
  Output output_;
  std::optional<Look::Camera> camera_;
  std::optional<ScreenPasses> screen_;
  std::optional<PointPass> points_;
  std::optional<MeshPass> meshes_;
  PassTimes pass_times_;
  Clock::time_point started_;
};

}  // namespace

std::unique_ptr<Renderer> Renderer::create(Backend backend, const Look& look, const Output& output,
                                           int threads) {
  check_size(output);
  return std::make_unique<GlRenderer>(make_context(backend, threads), look, output);
}

}  // namespace lather::render
