#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/frame.h"
#include "sim/scene/look.h"

/// Frames to pictures, without a screen. Reads only Frame and Look; no GL, EGL, OSMesa or PNG type leaves
/// this room.
namespace lather::render {

enum class Backend { kAuto, kOsmesa, kEgl };

/// "auto", "osmesa" or "egl"; throws InputError for anything else.
[[nodiscard]] Backend backend_from_string(std::string_view name);

/// An 8-bit sRGB picture; row 0 is the top one.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height
};

/// What a PNG says about itself, one text chunk each: "lather:scene", "lather:version", "Title",
/// "lather:time", "lather:frame", and compressed "lather:scene-json".
struct PngText {
  std::string scene_hash;
  std::string version;
  std::string scene_name;
  double time = 0;  ///< s
  int frame = 0;
  std::string scene_json = {};  ///< the scene in full, so that the picture can be made again
};

/// How long the last picture took, by pass, in the order of drawing: name and seconds.
using PassTimes = std::vector<std::pair<std::string, double>>;

/// Owns an off-screen GL context. A renderer belongs to the thread that created it: create, draw and destroy
/// it there, one renderer a thread. The same frame gives the same bytes, whatever was drawn before and
/// whatever the backend (see automatic_camera for the one thing that a renderer remembers).
class Renderer {
 public:
  /// kAuto tries OSMesa, then EGL. `threads` is the number of rasterizer threads, 0 for one per core.
  /// Sets MESA_SHADER_CACHE_DISABLE and LP_NUM_THREADS in the environment: call it before starting threads
  /// that read the environment. Throws InputError when `output` is larger than can be drawn,
  /// std::runtime_error with every backend tried and why each failed.
  [[nodiscard]] static std::unique_ptr<Renderer> create(Backend backend, const Look& look,
                                                        const Output& output, int threads = 0);
  virtual ~Renderer() = default;

  /// Throws std::runtime_error when a coordinate, velocity or shown scalar is not finite, or the frame lacks
  /// the scalar that the look asks for.
  [[nodiscard]] virtual Image draw(const Frame& frame) = 0;

  /// draw() as the bytes of a PNG file.
  [[nodiscard]] virtual std::string draw_png(const Frame& frame, const PngText& text) = 0;

  /// For the log and the report, e.g. "osmesa 22.3.6 (llvmpipe (LLVM 15.0.6, 256 bits))".
  [[nodiscard]] virtual const std::string& backend() const = 0;

  [[nodiscard]] virtual const PassTimes& pass_times() const = 0;
};

/// The camera that a look with an automatic one gets from `first`, the first frame drawn: all of that frame's
/// points and obstacles within the domain are in view, with room to move. A renderer calls it once and keeps
/// the answer; to draw a job in pieces with one camera, call it with frame 0 and put the answer into the
/// look.
[[nodiscard]] Look::Camera automatic_camera(const Look& look, const Output& output, const Frame& first);

[[nodiscard]] std::string encode_png(const Image& image, const PngText& text);

/// Throws std::runtime_error when the bytes are no whole 8-bit PNG.
[[nodiscard]] Image decode_png(std::string_view bytes);

/// The text chunks of a PNG as pairs of keyword and text; throws like decode_png.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> png_text(std::string_view bytes);

}  // namespace lather::render
