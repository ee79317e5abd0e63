// SPDX-License-Identifier: Apache-2.0
#include "pharos/camera/pinhole_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pharos {
namespace {

// Table 1 of paper 000, with some tangential distortion and k3 so that every term counts.
PinholeCamera paper_camera() {
  return {640, 480, 608.61, 605.04, 321.85, 238.94, {-0.1991, 0.0809, 0.0021, -0.0002, 0.004}};
}

TEST(PinholeCamera, ProjectsAsOpenCvDoes) {
  // Computed by hand from OpenCV's documentation of the model: ray (0.3, -0.2), r2 = 0.13.
  const PinholeCamera camera = paper_camera();
  const double radial = 1.0 - 0.1991 * 0.13 + 0.0809 * 0.13 * 0.13 + 0.004 * 0.13 * 0.13 * 0.13;
  const double x = 0.3 * radial + 2.0 * 0.0021 * 0.3 * -0.2 - 0.0002 * (0.13 + 2.0 * 0.09);
  const double y = -0.2 * radial + 0.0021 * (0.13 + 2.0 * 0.04) + 2.0 * -0.0002 * 0.3 * -0.2;
  const auto pixel = project(camera, {0.6, -0.4, 2.0});
  ASSERT_TRUE(pixel.ok());
  EXPECT_NEAR(pixel->x(), 608.61 * x + 321.85, 1e-10);
  EXPECT_NEAR(pixel->y(), 605.04 * y + 238.94, 1e-10);
}

TEST(PinholeCamera, UndistortionIsTheInverseOfProjectionAllOverTheImage) {
  const PinholeCamera camera = paper_camera();
  for (int v = -20; v < 500; v += 20) {
    for (int u = -20; u < 660; u += 20) {
      const auto ray = undistort(camera, Vector2(u, v));
      ASSERT_TRUE(ray.ok()) << u << " " << v << " " << name_of(ray.error());
      const auto pixel = project(camera, {3.0 * ray->x(), 3.0 * ray->y(), 3.0});
      ASSERT_TRUE(pixel.ok());
      EXPECT_NEAR(pixel->x(), u, 1e-8);
      EXPECT_NEAR(pixel->y(), v, 1e-8);
    }
  }
}

TEST(PinholeCamera, JacobiansAreThoseOfCentralDifferences) {
  const PinholeCamera camera = paper_camera();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int k = 0; k < 100; ++k) {
    const double z = 3.0 + uniform(random);
    const Vector3 point(z * 0.5 * uniform(random), z * 0.4 * uniform(random), z);
    const Matrix23 jacobian = project_jacobian(camera, point);
    for (int axis = 0; axis < 3; ++axis) {
      const double h = 1e-5;
      const Vector3 step = h * Vector3::Unit(axis);
      const Vector2 slope = (*project(camera, point + step) - *project(camera, point - step)) / (2.0 * h);
      EXPECT_LT((slope - jacobian.col(axis)).norm(), 1e-5) << "axis " << axis;
    }
  }
}

TEST(PinholeCamera, SaysWhereTheModelFolds) {
  PinholeCamera camera = paper_camera();
  camera.distortion = {-0.5, 0.0, 0.0, 0.0, 0.0};  // r (1 - r2/2) has its maximum of 0.544 at r2 = 2/3
  EXPECT_EQ(project(camera, {0.9, 0.0, 1.0}).error(), CameraFailure::kOutsideModel);
  EXPECT_FALSE(undistort(camera, {camera.cx_px + 0.6 * camera.fx_px, camera.cy_px}).ok());
  const auto just_inside = undistort(camera, {camera.cx_px + 0.5 * camera.fx_px, camera.cy_px});
  ASSERT_TRUE(just_inside.ok());
  EXPECT_LT(just_inside->x(), std::sqrt(2.0 / 3.0));
  EXPECT_EQ(project(camera, {0.0, 0.0, 0.0}).error(), CameraFailure::kBehindCamera);
  EXPECT_EQ(project(camera, {0.0, 0.0, -1.0}).error(), CameraFailure::kBehindCamera);
}

TEST(PinholeCamera, NanNeverLeaves) {
  const PinholeCamera camera = paper_camera();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(undistort(camera, {nan, 3.0}).ok());
  EXPECT_FALSE(undistort(camera, {1e300, 3.0}).ok());
  EXPECT_FALSE(project(camera, {nan, 0.0, 1.0}).ok());
  EXPECT_FALSE(project(camera, {0.0, 0.0, nan}).ok());
}

TEST(PinholeCamera, OnlyPositiveFiniteOnesAreUsable) {
  EXPECT_TRUE(is_usable(paper_camera()));
  for (int broken = 0; broken < 4; ++broken) {
    PinholeCamera camera = paper_camera();
    if (broken == 0) camera.width_px = 0;
    if (broken == 1) camera.fy_px = -605.0;
    if (broken == 2) camera.distortion[3] = std::numeric_limits<double>::infinity();
    if (broken == 3) camera.cx_px = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_usable(camera)) << broken;
  }
}

}  // namespace
}  // namespace pharos
