#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/render.h"
#include "tests/unit/render/sample_frames.h"

namespace lather::render {
namespace {

Look::Camera camera_from(const Vec3& eye, const Vec3& target, double field_of_view_deg) {
  Look::Camera camera;
  camera.automatic = false;
  camera.eye = eye;
  camera.target = target;
  camera.field_of_view_deg = field_of_view_deg;
  return camera;
}

const Box3 kUnitBox = {Vec3::Constant(-1), Vec3::Constant(1)};

TEST(Camera, TargetIsInTheMiddleOfThePicture) {
  const View view = perspective_view(camera_from({3, 2, 5}, {0.5, 0.25, -0.5}, 40), 1.5, kUnitBox);
  EXPECT_LT(view.project({0.5, 0.25, -0.5}).head<2>().norm(), 1e-12);
}

TEST(Camera, FieldOfViewIsTheVerticalAngleBetweenTheEdges) {
  const View view = perspective_view(camera_from({0, 0, 4}, {0, 0, 0}, 60), 2.0, kUnitBox);
  const double half_height = 4 * std::tan(EIGEN_PI / 6);
  EXPECT_NEAR(view.project({0, half_height, 0}).y(), 1, 1e-12);
  EXPECT_NEAR(view.project({0, -half_height, 0}).y(), -1, 1e-12);
  EXPECT_NEAR(view.project({2 * half_height, 0, 0}).x(), 1, 1e-12);
}

TEST(Camera, UpAndRightInTheWorldAreUpAndRightInThePicture) {
  const View view = perspective_view(camera_from({0, 1, 4}, {0, 0, 0}, 60), 1.0, kUnitBox);
  EXPECT_GT(view.project({0, 0.5, 0}).y(), view.project({0, 0, 0}).y());
  EXPECT_GT(view.project({0.5, 0, 0}).x(), view.project({0, 0, 0}).x());
}

TEST(Camera, LookingStraightDownHasAPictureToo) {
  const View view = perspective_view(camera_from({0, 4, 0}, {0, 0, 0}, 60), 1.0, kUnitBox);
  EXPECT_TRUE(view.project({0.3, 0.1, 0.2}).allFinite());
  EXPECT_GT(view.project({0.5, 0, 0}).x(), 0);
}

TEST(Camera, NearAndFarPlanesEncloseTheContent) {
  const View view = perspective_view(camera_from({0, 0.5, 4}, {0, 0, 0}, 60), 1.0, kUnitBox);
  for (const Vec3& corner : corners(kUnitBox)) {
    EXPECT_GT(view.project(corner).z(), -1);
    EXPECT_LT(view.project(corner).z(), 1);
  }
}

TEST(Camera, FramingKeepsAllPointsInsideAndTouchesTheMargin) {
  for (const double aspect : {0.5, 1.0, 16.0 / 9}) {
    const Box3 box = {Vec3(-0.2, 0, 1), Vec3(0.7, 0.4, 1.5)};
    const Look::Camera camera = framing_camera(corners(box), {0.45, 0.36, 1}, 35, aspect);
    const View view = perspective_view(camera, aspect, box);
    double furthest = 0;
    for (const Vec3& corner : corners(box))
      furthest = std::max(furthest, view.project(corner).head<2>().cwiseAbs().maxCoeff());
    EXPECT_NEAR(furthest, 1 / 1.06, 1e-9) << aspect;
  }
}

TEST(Camera, AutomaticCameraSeesAllPointsOfTheFirstFrame) {
  const Frame frame = dollop_under_block(2000);
  const Output output;
  const double aspect = static_cast<double>(output.width) / output.height;
  const View view = perspective_view(automatic_camera(Look{}, output, frame), aspect, frame.domain);
  for (const auto& p : frame.points.position) {
    const Vec3 ndc = view.project(Vec3(p[0], p[1], p[2]));
    ASSERT_LT(ndc.head<2>().cwiseAbs().maxCoeff(), 1);
  }
}

TEST(Camera, AutomaticCameraOfAnEmptyFrameSeesTheDomain) {
  const Frame frame = empty_frame();
  const View view = perspective_view(automatic_camera(Look{}, Output{}, frame), 16.0 / 9, frame.domain);
  for (const Vec3& corner : corners(frame.domain))
    EXPECT_LT(view.project(corner).head<2>().cwiseAbs().maxCoeff(), 1);
}

TEST(Camera, FlatViewShowsTheWholeDomainUndistorted) {
  const Box3 domain = {Vec3(-1, 2, 0), Vec3(3, 3, 0)};
  for (const double aspect : {0.5, 1.0, 3.0, 6.0}) {
    const View view = flat_view(domain, aspect);
    for (const Vec3& corner : corners(domain)) EXPECT_LT(view.project(corner).cwiseAbs().maxCoeff(), 1);
    const Vec3 a = view.project({0, 2, 0}), x = view.project({1, 2, 0}), y = view.project({0, 3, 0});
    EXPECT_NEAR((x - a).x() * aspect, (y - a).y(), 1e-12);
    EXPECT_GT((x - a).x(), 0);
    EXPECT_GT((y - a).y(), 0);
  }
}

}  // namespace
}  // namespace lather::render
