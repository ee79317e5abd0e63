// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/rig_file.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "pharos/geometry/rotation.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

RigCamera camera_at(const std::array<double, 4>& rotation_wxyz, const std::array<double, 3>& position_m) {
  RigCamera camera;
  camera.intrinsics = {1280, 1024, 600.0, 601.0, 639.5, 511.5, {0.1, -0.2, 0.001, 0.002, 0.3}};
  camera.rotation_wxyz = rotation_wxyz;
  camera.position_m = position_m;
  return camera;
}

RigFile some_rig() {
  const Quaternion q(rotation_exp({0.01, -0.2, 0.03}));
  return {camera_at({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}),
          camera_at({q.w(), q.x(), q.y(), q.z()}, {0.5, 1.0 / 300.0, -0.01}), std::nullopt};
}

std::string message(const RigFile& rig) {
  return pharos::test::error_of([&] { (void)parse_rig(rig_text(rig), "rig.toml"); });
}

TEST(RigFile, ReadsBackExactlyWhatItWrites) {
  RigFile rig = some_rig();
  rig.calibration = CalibrationRecord{13, 1404, 0.2, {"left.fx_px"}, {{0.01}}, {}};
  const RigFile read = parse_rig(rig_text(rig), "rig.toml");
  EXPECT_EQ(read.right.rotation_wxyz, rig.right.rotation_wxyz);
  EXPECT_EQ(read.right.position_m, rig.right.position_m);
  EXPECT_EQ(read.right.intrinsics.distortion, rig.right.intrinsics.distortion);
  EXPECT_EQ(read.left.position_m, rig.left.position_m);
  ASSERT_TRUE(read.calibration);
  EXPECT_EQ(read.calibration->covariance, rig.calibration->covariance);
  EXPECT_EQ(rig_text(read), rig_text(rig));
}

TEST(RigFile, PoseTakesCameraCoordinatesToTheRig) {
  const double half = std::sqrt(0.5);
  const RigCamera right = camera_at({half, 0.0, half, 0.0}, {0.5, 0.0, 0.0});  // optical axis along the rig's x
  EXPECT_LT((right.pose() * Vector3(0.0, 0.0, 2.0) - Vector3(2.5, 0.0, 0.0)).norm(), 1e-12);
}

TEST(RigFile, TakesAQuaternionOfFourDigitsAndMakesItARotation) {
  RigFile rig = some_rig();
  rig.right.rotation_wxyz = {0.7071, 0.0, 0.7071, 0.0};
  const Matrix3 R = parse_rig(rig_text(rig), "rig.toml").right.pose().R;
  EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-12);
}

TEST(RigFile, RefusesARotationThatIsNone) {
  RigFile rig = some_rig();
  rig.right.rotation_wxyz = {0.9, 0.0, 0.0, 0.0};
  EXPECT_TRUE(message(rig).ends_with("right.rotation_wxyz: is no rotation: the four numbers' squares must add up to 1"))
      << message(rig);
}

TEST(RigFile, RefusesCamerasInOnePlace) {
  RigFile rig = some_rig();
  rig.right.position_m = rig.left.position_m;
  EXPECT_NE(message(rig).find("right.position_m: is the left camera's"), std::string::npos) << message(rig);
}

TEST(RigFile, RefusesAMissingCamera) {
  const std::string text = rig_text(some_rig());
  EXPECT_THROW((void)parse_rig(text.substr(0, text.find("[right]")), "rig.toml"), InputError);
}

}  // namespace
}  // namespace pharos::host
