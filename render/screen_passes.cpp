#include "render/screen_passes.h"

#include <algorithm>

#include "render/shaders.h"

namespace lather::render {
namespace {

constexpr int kShadowSide = 2048;  // px
constexpr TextureFormat kDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT};
constexpr TextureFormat kShadowDepth{GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, true};
constexpr TextureFormat kColor{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};
constexpr TextureFormat kNormal{GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV};
constexpr TextureFormat kFraction{GL_R8, GL_RED, GL_UNSIGNED_BYTE};

Program make(const Gl& gl, const char* label, const shaders::Stages& stages) {
  return Program(gl, label, stages.vertex, stages.fragment);
}

/// From camera space to the shadow map's texture coordinates and depth.
Mat4 shadow_from_camera(const Shot& shot) {
  Mat4 half = Mat4::Identity() * 0.5;
  half.topRightCorner<3, 1>().setConstant(0.5);
  half(3, 3) = 1;
  return half * shot.shadow_clip_from_world * shot.view.camera_from_world.inverse();
}

}  // namespace

ScreenPasses::ScreenPasses(const Gl& gl, const Output& output)
    : gl_(gl),
      width_(output.width),
      height_(output.height),
      samples_(output.supersampling),
      shadow_map_(gl, kShadowSide, kShadowSide, kShadowDepth),
      albedo_map_(gl, width_ * samples_, height_ * samples_, kColor),
      normal_map_(gl, width_ * samples_, height_ * samples_, kNormal),
      depth_map_(gl, width_ * samples_, height_ * samples_, kDepth),
      open_map_(gl, width_, height_, kFraction),
      blurred_open_map_(gl, width_, height_, kFraction),
      picture_map_(gl, width_, height_, kColor),
      shadow_(gl, kShadowSide, kShadowSide, {}, &shadow_map_),
      geometry_(gl, width_ * samples_, height_ * samples_, {&albedo_map_, &normal_map_}, &depth_map_),
      open_(gl, width_, height_, {&open_map_}, nullptr),
      blurred_open_(gl, width_, height_, {&blurred_open_map_}, nullptr),
      picture_(gl, width_, height_, {&picture_map_}, nullptr),
      occlusion_(make(gl, "occlusion", shaders::occlusion())),
      blur_occlusion_(make(gl, "blur occlusion", shaders::blur_occlusion())),
      composite_(make(gl, "composite", shaders::composite())),
      no_vertices_(gl) {}

void ScreenPasses::begin_shadow() const {
  shadow_.bind();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void ScreenPasses::begin_geometry() const {
  geometry_.bind();
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Enable(GL_PROGRAM_POINT_SIZE);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void ScreenPasses::start(const Program& program, const Shot& shot) const {
  const Mat4& m = shot.view.clip_from_camera;
  program.use();
  program.set("projection", Eigen::Vector4d(m(0, 0), m(1, 1), m(2, 2), m(2, 3)));
  program.set("orthographic", shot.view.orthographic ? 1 : 0);
  program.set("size", width_, height_);
  program.set("samples", samples_);
}

void ScreenPasses::cover(const Framebuffer& target) const {
  target.bind();
  gl_.Disable(GL_DEPTH_TEST);
  no_vertices_.bind();
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenPasses::occlude(const Shot& shot) const {
  const double shape = 0.12 * shot.content.extent().norm();  // m
  const double contact = std::max(5 * shot.point_radius, 0.2 * shape);
  start(occlusion_, shot);
  occlusion_.set_texture("albedo_map", 0, albedo_map_.id());
  occlusion_.set_texture("normal_map", 1, normal_map_.id());
  occlusion_.set_texture("depth_map", 2, depth_map_.id());
  occlusion_.set("radius", shot.point_radius);
  occlusion_.set("reach", contact, std::max(shape, contact));
  cover(open_);
  start(blur_occlusion_, shot);
  blur_occlusion_.set_texture("depth_map", 1, depth_map_.id());
  blur_occlusion_.set("reach", contact);
  // Twice: the first takes out the pattern of the samples' turns, the second what is left of it at rough
  // edges.
  blur_occlusion_.set_texture("open_map", 0, open_map_.id());
  cover(blurred_open_);
  blur_occlusion_.set_texture("open_map", 0, blurred_open_map_.id());
  cover(open_);
}

void ScreenPasses::composite(const Shot& shot, const Look& look) const {
  start(composite_, shot);
  composite_.set_texture("albedo_map", 0, albedo_map_.id());
  composite_.set_texture("normal_map", 1, normal_map_.id());
  composite_.set_texture("depth_map", 2, depth_map_.id());
  composite_.set_texture("open_map", 3, open_map_.id());
  composite_.set_texture("shadow_map", 4, shadow_map_.id());
  composite_.set("shadows", shot.shadows ? 1 : 0);
  composite_.set("shadow_from_camera", shadow_from_camera(shot));
  composite_.set("shadow_texel", 1.0 / kShadowSide);
  composite_.set("shadow_offset", 2.5 * shot.shadow_side / kShadowSide);
  composite_.set("radius", shot.point_radius);
  composite_.set("key", shot.view.rotate(shot.lights.key));
  composite_.set("fill", shot.view.rotate(shot.lights.fill));
  composite_.set("rim", shot.view.rotate(shot.lights.rim));
  composite_.set("up", shot.view.rotate(Vec3(0, 1, 0)));
  composite_.set("floor_center", shot.view.to_camera(shot.floor_center));
  composite_.set("floor_fade", shot.floor_fade);
  composite_.set("background", Vec3(look.background[0], look.background[1], look.background[2]));
  cover(picture_);
}

Image ScreenPasses::read() const {
  Image image{width_, height_, std::vector<std::uint8_t>(std::size_t{3} * width_ * height_)};
  picture_.bind();
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const std::size_t row = std::size_t{3} * width_;
  for (int y = 0; y < height_ / 2; ++y)
    std::swap_ranges(image.rgb.begin() + static_cast<std::ptrdiff_t>(y * row),
                     image.rgb.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     image.rgb.end() - static_cast<std::ptrdiff_t>((y + 1) * row));
  return image;
}

}  // namespace lather::render
