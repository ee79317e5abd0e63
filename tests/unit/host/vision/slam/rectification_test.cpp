// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/rectification.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"

namespace pharos::slam {
namespace {

// Two cameras with barrel distortion, rotated relative to each other and to their baseline.
host::RigFile raw_rig() {
  host::RigFile rig;
  rig.left.intrinsics = {752, 480, 458.6, 457.3, 367.2, 248.4, {-0.283, 0.074, 0.0002, 0.00002, 0.0}};
  rig.right.intrinsics = {752, 480, 457.6, 456.1, 379.9, 255.2, {-0.284, 0.0745, -0.0001, -0.00003, 0.0}};
  const Quaternion left(rotation_exp(Vector3(0.02, -0.01, 0.03))), right(rotation_exp(Vector3(-0.01, 0.02, 0.015)));
  rig.left.rotation_wxyz = {left.w(), left.x(), left.y(), left.z()};
  rig.right.rotation_wxyz = {right.w(), right.x(), right.y(), right.z()};
  rig.left.position_m = {0.2, 0.1, -0.3};
  rig.right.position_m = {0.31, 0.102, -0.298};
  return rig;
}

// The rectified position of the raw pixel `raw`: nearest entry of the map, corrected by its gradient.
Vector2 rectified_place(const RectifyMap& map, const StereoCamera& camera, const Vector2& raw) {
  const auto at = [&](const std::vector<float>& values, int u, int v) {
    return static_cast<double>(values[static_cast<std::size_t>(v * camera.width_px + u)]);
  };
  int best_u = 1, best_v = 1;
  double minimum = 1e18;
  for (int v = 1; v + 1 < camera.height_px; ++v) {
    for (int u = 1; u + 1 < camera.width_px; ++u) {
      const double d = (Vector2(at(map.u, u, v), at(map.v, u, v)) - raw).squaredNorm();
      if (d < minimum) {
        minimum = d;
        best_u = u;
        best_v = v;
      }
    }
  }
  Matrix2 slope;
  slope << at(map.u, best_u + 1, best_v) - at(map.u, best_u - 1, best_v),
      at(map.u, best_u, best_v + 1) - at(map.u, best_u, best_v - 1),
      at(map.v, best_u + 1, best_v) - at(map.v, best_u - 1, best_v),
      at(map.v, best_u, best_v + 1) - at(map.v, best_u, best_v - 1);
  const Vector2 rest = raw - Vector2(at(map.u, best_u, best_v), at(map.v, best_u, best_v));
  return Vector2(best_u, best_v) + 2.0 * slope.inverse() * rest;
}

TEST(Rectification, RowsAgreeAndDisparityGivesDepth) {
  const host::RigFile rig = raw_rig();
  const Rectification rectified = rectify(rig, "rig.toml");
  ASSERT_TRUE(rectified.needed());
  const StereoCamera& camera = rectified.camera;
  const auto T_left_rig = rig.left.pose().inverse(), T_right_rig = rig.right.pose().inverse();
  EXPECT_NEAR(camera.baseline_m, (rig.left.pose().t - rig.right.pose().t).norm(), 1e-12);
  for (const Vector3& in_left : {Vector3(0.1, -0.2, 2.0), Vector3(-0.8, 0.5, 3.0), Vector3(0.6, 0.3, 1.5)}) {
    const Vector3 in_rig = rig.left.pose() * in_left;
    const auto left = project(rig.left.intrinsics, T_left_rig * in_rig);
    const auto right = project(rig.right.intrinsics, T_right_rig * in_rig);
    ASSERT_TRUE(left && right);
    const Vector2 l = rectified_place(rectified.maps[0], camera, *left);
    const Vector2 r = rectified_place(rectified.maps[1], camera, *right);
    EXPECT_NEAR(l.y(), r.y(), 0.01);
    const Vector3 p = rectified.R_left_rectified.transpose() * in_left;
    EXPECT_NEAR(camera.depth_m(l.x() - r.x()), p.z(), 1e-3 * p.z());
    EXPECT_LT((camera.project(p).head<2>() - l).norm(), 0.01);
  }
}

TEST(Rectification, LeavesARectifiedPairAlone) {
  host::RigFile rig;
  rig.left.intrinsics = rig.right.intrinsics = {640, 480, 640.0, 640.0, 319.5, 239.5, {}};
  rig.right.position_m = {0.5, 0.0, 0.0};
  const Rectification rectified = rectify(rig, "rig.toml");
  EXPECT_FALSE(rectified.needed());
  EXPECT_EQ(rectified.camera.baseline_m, 0.5);
  EXPECT_EQ(rectified.R_left_rectified, Matrix3::Identity());
}

void expect_refused(const host::RigFile& rig, const std::string& word) {
  try {
    rectify(rig, "rig.toml");
    FAIL() << word;
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
  }
}

TEST(Rectification, RefusesRigsThatMeasureNoDepth) {
  host::RigFile rig = raw_rig();
  rig.right.position_m = rig.left.position_m;
  expect_refused(rig, "no baseline");
  rig = raw_rig();
  std::swap(rig.left, rig.right);
  expect_refused(rig, "exchange");
  rig = raw_rig();
  rig.right.intrinsics.width_px = 640;
  expect_refused(rig, "different sizes");
  rig = raw_rig();
  rig.right.rotation_wxyz = {0.5, 0.0, 0.8660254, 0.0};
  expect_refused(rig, "apart");
}

}  // namespace
}  // namespace pharos::slam
