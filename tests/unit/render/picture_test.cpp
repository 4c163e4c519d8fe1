#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>

#include "render/camera.h"
#include "render/render.h"
#include "sim/error.h"
#include "sim/surface/skin.h"
#include "tests/unit/render/sample_frames.h"

namespace lather::render {
namespace {

Output size(int width, int height) {
  Output output;
  output.width = width;
  output.height = height;
  return output;
}

/// No floor, no shadow: only what is asked about changes the picture.
Look bare_look(const Vec3& eye, const Vec3& target) {
  Look look;
  look.point_scale = 1;  // drawn as large as they are
  look.floor = false;
  look.shadows = false;
  look.camera.automatic = false;
  look.camera.eye = eye;
  look.camera.target = target;
  return look;
}

Image draw(const Frame& frame, const Look& look, const Output& output) {
  return Renderer::create(Backend::kAuto, look, output)->draw(frame);
}

int difference(const Image& a, const Image& b, std::size_t pixel) {
  int sum = 0;
  for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += std::abs(a.rgb[i] - b.rgb[i]);
  return sum;
}

struct Blob {
  double area = 0;      // px
  double x = 0, y = 0;  // centre, px from the top left
};

/// Where two pictures differ.
Blob changed(const Image& a, const Image& b) {
  Blob blob;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      if (difference(a, b,
                     static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) +
                         static_cast<std::size_t>(x)) < 12)
        continue;
      blob.area += 1;
      blob.x += x + 0.5;
      blob.y += y + 0.5;
    }
  blob.x /= std::max(blob.area, 1.0);
  blob.y /= std::max(blob.area, 1.0);
  return blob;
}

/// Area in px of a sphere's picture: an ellipse with the half axes r sqrt(D^2 - r^2) / (z^2 - r^2) and
/// r / sqrt(z^2 - r^2) at unit focal length, D the centre's distance and z its depth.
double projected_area(const View& view, const Vec3& center, double radius, int height) {
  const Vec3 c = view.to_camera(center);
  const double gap = c.z() * c.z() - radius * radius;
  const double major = radius * std::sqrt(c.squaredNorm() - radius * radius) / gap;
  const double minor = radius / std::sqrt(gap);
  const double focal = 0.5 * height * view.clip_from_camera(1, 1);
  return EIGEN_PI * major * minor * focal * focal;
}

/// The picture of one sphere against the closed form. The outline counts from the first touched sample on,
/// which adds up to half a pixel all around: 2 % for a radius of 50 px.
void expect_silhouette(const Vec3& center, double radius) {
  Frame frame = empty_frame();
  frame.point_radius = radius;
  const Look look = bare_look({0, 0.3, 2}, {0, 0.3, 0});
  const Output output = size(640, 480);
  const Image without = draw(frame, look, output);
  add_point(frame, center);
  const Image with = draw(frame, look, output);
  const View view = perspective_view(look.camera, 640.0 / 480, frame.domain);
  const double expected = projected_area(view, center, radius, 480);
  const double half_pixel_rim = 0.5 * 2 * std::sqrt(EIGEN_PI * expected);
  const Blob blob = changed(with, without);
  EXPECT_GT(blob.area, expected * 0.99);
  EXPECT_LT(blob.area, expected * 1.01 + half_pixel_rim);
  EXPECT_NEAR(blob.x, 320 * (1 + view.project(center).x()), 4);
  EXPECT_NEAR(blob.y, 240 * (1 - view.project(center).y()), 4);
}

TEST(Silhouette, OfASphereInTheMiddleHasTheProjectedArea) {
  expect_silhouette({0, 0.3, 0}, 0.1);
}

TEST(Silhouette, OfASphereOffTheAxisHasTheProjectedArea) {
  expect_silhouette({0.5, 0.5, 0.2}, 0.08);
}

TEST(Silhouette, OfASphereTooLargeForASpriteHasTheProjectedArea) {
  expect_silhouette({0.1, 0.25, 0.3}, 0.35);
}

TEST(Silhouette, OfABallOfPointsHasTheProjectedArea) {
  Frame frame = empty_frame();
  const Vec3 center(0, 0.3, 0);
  const double radius = 0.2;
  frame.point_radius = 0.005;
  const int turns = 20000;  // points of a Fibonacci spiral on the sphere
  for (int i = 0; i < turns; ++i) {
    const double y = 1 - 2 * (i + 0.5) / turns, angle = i * EIGEN_PI * (3 - std::sqrt(5.0));
    const double ring = std::sqrt(1 - y * y);
    add_point(frame, center + radius * Vec3(ring * std::cos(angle), y, ring * std::sin(angle)));
  }
  const Look look = bare_look({0, 0.3, 2}, {0, 0.3, 0});
  const Image with = draw(frame, look, size(640, 480));
  const Image without = draw(empty_frame(), look, size(640, 480));
  const View view = perspective_view(look.camera, 640.0 / 480, frame.domain);
  const double expected = projected_area(view, center, radius + frame.point_radius, 480);
  EXPECT_NEAR(changed(with, without).area, expected, 0.02 * expected);
}

/// The frame's points as their skin.
Frame skinned(Frame frame) {
  frame.skins = skins_of(frame, 1);
  return frame;
}

TEST(Silhouette, OfASkinHasTheProjectedAreaOfItsMaterial) {
  Frame frame = empty_frame();
  frame.point_radius = 0.01;
  const Vec3 center(0, 0.3, 0);
  for (int i = -10; i < 10; ++i)
    for (int j = -10; j < 10; ++j)
      for (int k = -10; k < 10; ++k)
        if (const Vec3 x = 0.02 * Vec3(i + 0.5, j + 0.5, k + 0.5); x.norm() < 0.2)
          add_point(frame, center + x);
  frame = skinned(frame);
  Look look = bare_look({0, 0.3, 2}, {0, 0.3, 0});
  look.style = "skin";
  look.point_scale = 40;  // were the points drawn, they would fill the picture
  const Image with = draw(frame, look, size(640, 480));
  const Image without = draw(empty_frame(), look, size(640, 480));
  const View view = perspective_view(look.camera, 640.0 / 480, frame.domain);
  // The lattice's rim reaches the sphere here and there, and its skin half a distance further.
  const double expected = projected_area(view, center, 0.2, 480);
  EXPECT_NEAR(changed(with, without).area, expected, 0.05 * expected);
}

TEST(Picture, OfASkinHasTheColourOfItsMaterialAndThrowsAShadow) {
  const Frame frame = skinned(dollop(2000));
  Look look;
  look.style = "skin";
  look.material_colors = {{0.9, 0.1, 0.1}};
  const Image red = draw(frame, look, size(160, 120));
  std::size_t reddish = 0;
  for (std::size_t i = 0; i + 2 < red.rgb.size(); i += 3)
    if (red.rgb[i] > 2 * red.rgb[i + 1] + 20) ++reddish;
  EXPECT_GT(reddish, red.rgb.size() / 3 / 50);
  look.shadows = false;
  EXPECT_GT(changed(red, draw(frame, look, size(160, 120))).area, 50);
}

TEST(Picture, OfASkinThatTheFrameLacksIsRefused) {
  Look look;
  look.style = "skin";
  EXPECT_THROW((void)draw(dollop(500), look, size(64, 64)), std::runtime_error);
}

TEST(Picture, OsmesaAndEglAgree) {
  Look look;
  look.color_by = "speed";
  // Both are in the list of packages that the tests install: a missing one is a failure.
  const auto osmesa = Renderer::create(Backend::kOsmesa, look, size(320, 240));
  const auto egl = Renderer::create(Backend::kEgl, look, size(320, 240));
  const Frame frame = dollop_under_block(5000);
  // In turns, for each must find its own context again.
  for (int turn = 0; turn < 2; ++turn) {
    const Image a = osmesa->draw(frame), b = egl->draw(frame);
    if (egl->backend().find("llvmpipe") != std::string::npos) {
      EXPECT_TRUE(a.rgb == b.rgb) << osmesa->backend() << " and " << egl->backend();
    } else {  // another rasterizer may round otherwise: edges move by a sample
      EXPECT_LT(changed(a, b).area, 0.01 * 320 * 240) << osmesa->backend() << " and " << egl->backend();
    }
  }
}

TEST(Picture, TheSameFrameGivesTheSameBytes) {
  const Frame frame = dollop_under_block(5000);
  const PngText text = {"hash", "0.1", "dollop", 0, 0};
  const Output output = size(320, 240);
  auto one = Renderer::create(Backend::kAuto, Look{}, output, 1);
  const std::string first = one->draw_png(frame, text);
  EXPECT_TRUE(one->draw_png(frame, text) == first);
  EXPECT_TRUE(Renderer::create(Backend::kAuto, Look{}, output, 3)->draw_png(frame, text) == first);
}

TEST(Picture, AnAutomaticCameraStaysWhereTheFirstFramePutIt) {
  const Output output = size(320, 240);
  Frame later = dollop(3000);
  later.points.position.front() = {0.4F, 0.5F, 0.4F};
  auto kept = Renderer::create(Backend::kAuto, Look{}, output);
  const Frame first = dollop(3000);
  (void)kept->draw(first);
  Look resolved;
  resolved.camera = automatic_camera(resolved, output, first);
  EXPECT_TRUE(kept->draw(later).rgb == draw(later, resolved, output).rgb);
}

/// Mean brightness and spread over what the dollop covers, and the part of it that is clipped.
struct Tones {
  double mean = 0, spread = 0, clipped = 0;
};

Tones tones_of(const Image& with, const Image& without) {
  double count = 0, sum = 0, squares = 0, clipped = 0;
  for (std::size_t i = 0; i < with.rgb.size() / 3; ++i) {
    if (difference(with, without, i) < 12) continue;
    const double value = (with.rgb[3 * i] + with.rgb[3 * i + 1] + with.rgb[3 * i + 2]) / 3.0;
    count += 1;
    sum += value;
    squares += value * value;
    clipped += value > 252 ? 1 : 0;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(squares / count - mean * mean), clipped / count};
}

TEST(Picture, WhiteFoamShowsItsShapeAndIsNotClipped) {
  Look look;
  look.point_scale = 1.4;
  const Frame frame = dollop_under_block(50000);
  auto renderer = Renderer::create(Backend::kAuto, look, Output{});
  const std::string png = renderer->draw_png(frame, {"", LATHER_VERSION, "dollop", 0, 0});
  std::ofstream("test_render_dollop.png", std::ios::binary) << png;  // beside the test binary, to look at
  Frame nothing = frame;
  nothing.points = {};
  nothing.obstacles.clear();
  look.camera = automatic_camera(look, Output{}, frame);
  const Tones tones = tones_of(decode_png(png), draw(nothing, look, Output{}));
  EXPECT_GT(tones.mean, 120);
  EXPECT_LT(tones.mean, 225);
  EXPECT_GT(tones.spread, 15);
  EXPECT_LT(tones.clipped, 0.01);
  for (const auto& [pass, seconds] : renderer->pass_times()) RecordProperty(pass, std::to_string(seconds));
}

TEST(Picture, AnObstacleCastsAShadowOnTheFloor) {
  Frame frame = empty_frame();
  FrameObstacle block;
  block.mesh = box_mesh({0.1, 0.05, 0.1});
  block.pose.translation = {0, 0.3, 0};
  frame.obstacles.push_back(block);
  Look look;
  look.camera = automatic_camera(look, size(320, 240), frame);
  const Image lit = [&] {
    Look without = look;
    without.shadows = false;
    return draw(frame, without, size(320, 240));
  }();
  const Image shadowed = draw(frame, look, size(320, 240));
  EXPECT_GT(changed(lit, shadowed).area, 200);
  int brighter = 0;
  for (std::size_t i = 0; i < lit.rgb.size(); ++i) brighter += shadowed.rgb[i] > lit.rgb[i] ? 1 : 0;
  EXPECT_EQ(brighter, 0);
}

TEST(Picture, ANearPointHidesTheOneBehindIt) {
  Look look = bare_look({0, 0.3, 2}, {0, 0.3, 0});
  look.material_colors = {{0.9, 0.1, 0.1}, {0.1, 0.1, 0.9}};
  for (const bool near_first : {true, false}) {
    Frame frame = empty_frame();
    frame.point_radius = 0.1;
    add_point(frame, {0, 0.3, near_first ? 0.4 : -0.4});
    add_point(frame, {0, 0.3, near_first ? -0.4 : 0.4});
    frame.points.material = near_first ? std::vector<std::uint8_t>{0, 1} : std::vector<std::uint8_t>{1, 0};
    const Image image = draw(frame, look, size(64, 64));
    const std::uint8_t* middle = &image.rgb[3 * (32 * 64 + 32)];
    EXPECT_GT(middle[0], middle[2] + 50);
  }
}

Blob flat_point(float x, float y) {
  Frame nothing = flat_frame(x, y, 0.02);
  nothing.points = {};
  Look look;
  look.point_scale = 1;
  return changed(draw(flat_frame(x, y, 0.02), look, size(400, 200)), draw(nothing, look, size(400, 200)));
}

TEST(FlatPicture, LargerYIsHigherAndLargerXIsFurtherRight) {
  const Blob base = flat_point(0.5F, 0.25F), right = flat_point(1.5F, 0.25F), up = flat_point(0.5F, 0.75F);
  EXPECT_GT(base.area, 10);
  EXPECT_NEAR(right.y, base.y, 0.5);
  EXPECT_GT(right.x, base.x + 150);
  EXPECT_NEAR(up.x, base.x, 0.5);
  EXPECT_LT(up.y, base.y - 80);
}

TEST(FlatPicture, ThePointHasItsAreaInTheDomainsScale) {
  const double px_per_m = 200 / 1.06;  // a margin of 3 % on each side of the height
  const double expected = EIGEN_PI * std::pow(0.02 * px_per_m, 2);
  EXPECT_NEAR(flat_point(1, 0.5F).area, expected, 0.5 * 2 * std::sqrt(EIGEN_PI * expected) + 2);
}

TEST(Refusal, NonFiniteContentNeverReachesAPicture) {
  auto renderer = Renderer::create(Backend::kAuto, Look{}, size(64, 64));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    Frame frame = dollop(500);
    frame.points.position[7][1] = bad;
    EXPECT_THROW((void)renderer->draw(frame), std::runtime_error);
    Frame posed = dollop_under_block(500);
    posed.obstacles.front().pose.translation.x() = bad;
    EXPECT_THROW((void)renderer->draw(posed), std::runtime_error);
  }
  EXPECT_NO_THROW((void)renderer->draw(dollop(500)));
}

TEST(Refusal, NamesThePointThatIsNotFinite) {
  auto renderer = Renderer::create(Backend::kAuto, Look{}, size(64, 64));
  Frame frame = dollop(500);
  frame.points.position[7][1] = std::numeric_limits<float>::quiet_NaN();
  try {
    (void)renderer->draw(frame);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("point 7 "), std::string::npos) << e.what();
  }
}

TEST(Refusal, OversizePicturesAreRefusedWithWhatIsAllowed) {
  Output output = size(20000, 100);
  output.supersampling = 1;
  try {
    (void)Renderer::create(Backend::kAuto, Look{}, output);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.problems().front().pointer, "/output/width");
    EXPECT_EQ(e.problems().front().value, "20000");
    EXPECT_NE(e.problems().front().allowed.find("16384"), std::string::npos);
  }
  EXPECT_THROW((void)Renderer::create(Backend::kAuto, Look{}, size(9000, 100)), InputError);
  EXPECT_THROW((void)Renderer::create(Backend::kAuto, Look{}, size(8192, 8192)), InputError);
  EXPECT_THROW((void)Renderer::create(Backend::kAuto, Look{}, size(0, 100)), InputError);
  EXPECT_THROW((void)Renderer::create(Backend::kAuto, Look{}, size(100, -1)), InputError);
}

TEST(Refusal, AnUnknownBackendIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(backend_from_string("auto"), Backend::kAuto);
  EXPECT_EQ(backend_from_string("osmesa"), Backend::kOsmesa);
  EXPECT_EQ(backend_from_string("egl"), Backend::kEgl);
  EXPECT_THROW((void)backend_from_string("vulkan"), InputError);
}

TEST(Picture, AFrameWithoutPointsHasAFloor) {
  Look no_floor;
  no_floor.floor = false;
  EXPECT_GT(
      changed(draw(empty_frame(), Look{}, size(160, 120)), draw(empty_frame(), no_floor, size(160, 120)))
          .area,
      1000);
}

}  // namespace
}  // namespace lather::render
