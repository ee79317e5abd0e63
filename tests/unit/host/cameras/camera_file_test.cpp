// SPDX-License-Identifier: Apache-2.0
#include "host/cameras/camera_file.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "tests/support/error_of.hpp"

namespace pharos::host {
namespace {

const std::string kPlain =
    "width_px = 640\nheight_px = 480\nfx_px = 608.61\nfy_px = 605.04\ncx_px = 321.85\ncy_px = 238.94\n"
    "distortion = [-0.1991, 0.0809, 0.0021, -0.0002, 0]\n";

std::string message(const std::string& text) {
  return pharos::test::error_of([&] { (void)parse_camera(text, "camera.toml"); });
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kPlain;
  return text.replace(text.find(from), from.size(), to);
}

TEST(CameraFile, ReadsThePapersCamera) {
  const CameraFile file = parse_camera(kPlain, "camera.toml");
  EXPECT_EQ(file.camera.intrinsics.width_px, 640);
  EXPECT_EQ(file.camera.intrinsics.height_px, 480);
  EXPECT_EQ(file.camera.intrinsics.fx_px, 608.61);
  EXPECT_EQ(file.camera.intrinsics.fy_px, 605.04);
  EXPECT_EQ(file.camera.intrinsics.cx_px, 321.85);
  EXPECT_EQ(file.camera.intrinsics.cy_px, 238.94);
  EXPECT_EQ(file.camera.intrinsics.distortion, (std::array<double, 5>{-0.1991, 0.0809, 0.0021, -0.0002, 0.0}));
  EXPECT_FALSE(file.calibration);
}

TEST(CameraFile, LeavesDepthAtItsDefaultsWhereTheFileIsSilent) {
  const DepthCamera camera = parse_camera(kPlain, "camera.toml").camera;
  EXPECT_EQ(camera.depth_scale_m, 0.00025);
  EXPECT_EQ(camera.depth_origin_z_m, 0.0);
}

TEST(CameraFile, ReadsBackExactlyWhatItWrites) {
  CameraFile file = parse_camera(kPlain, "camera.toml");
  file.camera.intrinsics.fx_px = 608.61 + 1.0 / 3.0;
  file.camera.intrinsics.distortion[4] = -1.0 / 7.0;
  file.camera.depth_scale_m = 0.0003;
  file.camera.depth_origin_z_m = -0.071;
  file.camera.scale_m = {0.0001, 0.0002, 0.0004};
  file.camera.offset_m = {-8.1, -8.2, 0.0};
  file.calibration = CalibrationRecord{
      20, 1920, 1.0 / 128.0 / 3.0, {"fx_px", "fy_px"}, {{0.1, 1e-9}, {1e-9, 0.2}}, {"k3: \"held\"\n\\ so"}};
  const CameraFile read = parse_camera(camera_text(file), "camera.toml");
  EXPECT_EQ(read.camera.intrinsics.fx_px, file.camera.intrinsics.fx_px);
  EXPECT_EQ(read.camera.intrinsics.distortion, file.camera.intrinsics.distortion);
  EXPECT_EQ(read.camera.depth_scale_m, file.camera.depth_scale_m);
  EXPECT_EQ(read.camera.depth_origin_z_m, file.camera.depth_origin_z_m);
  EXPECT_EQ(read.camera.scale_m, file.camera.scale_m);
  EXPECT_EQ(read.camera.offset_m, file.camera.offset_m);
  ASSERT_TRUE(read.calibration);
  EXPECT_EQ(read.calibration->images, 20);
  EXPECT_EQ(read.calibration->points, 1920);
  EXPECT_EQ(read.calibration->rms_px, file.calibration->rms_px);
  EXPECT_EQ(read.calibration->parameters, file.calibration->parameters);
  EXPECT_EQ(read.calibration->covariance, file.calibration->covariance);
  EXPECT_EQ(read.calibration->unobservable, file.calibration->unobservable);
}

TEST(CameraFile, RefusesWhatNoCameraHas) {
  const auto says = [](const std::string& text, const std::string& words) {
    return message(text).find(words) != std::string::npos;
  };
  EXPECT_TRUE(says(kPlain + "offset_m = [-8192.0, -8192.0, 0.0]\n", "offset_m: each must lie in -100 to 100"));
  EXPECT_TRUE(says(with("cx_px = 321.85", "cx_px = 641.0"), "cx_px: lies outside of the image"));
  EXPECT_TRUE(says(with("cy_px = 238.94", "cy_px = -1.0"), "cy_px: lies outside of the image"));
  EXPECT_TRUE(says(with("-0.1991, 0.0809", "-900.0, 0.0809"), "distortion: folds the image"));
}

TEST(CameraFile, NamesFileLineAndKeyOfWhatIsWrong) {
  EXPECT_EQ(message(with("fx_px = 608.61\n", "")), "camera.toml:1: fx_px: is missing");
  EXPECT_EQ(message(with("fx_px = 608.61", "fx_px = 0.5")), "camera.toml:3: fx_px: must lie in 1 to 1e+09, not 0.5");
  EXPECT_EQ(message(with("width_px = 640", "width_px = 640.5")),
            "camera.toml:1: width_px: must be an integer, not a number");
  EXPECT_EQ(message(with("height_px = 480", "height_px = 0")),
            "camera.toml:2: height_px: must lie in 1 to 32768, not 0");
  EXPECT_EQ(message(with("cx_px", "cz_px")), "camera.toml:1: cx_px: is missing");
  EXPECT_TRUE(message(kPlain + "dept_scale_m = 0.001\n").starts_with("camera.toml:8: dept_scale_m:"));
  EXPECT_TRUE(message(kPlain + "depth_scale_m = -0.001\n").starts_with("camera.toml:8: depth_scale_m:"));
  EXPECT_TRUE(message(with("0.0021, ", "")).starts_with("camera.toml:7: distortion:"));
  EXPECT_TRUE(message(with("0.0021", "nan")).starts_with("camera.toml:7: distortion"));
  EXPECT_TRUE(message(kPlain + "[calibration]\nimages = 2\npoints = 9\nrms_px = 0.1\nparameters = [\"fx_px\"]\n")
                  .starts_with("camera.toml:8: calibration.covariance:"));
}

}  // namespace
}  // namespace pharos::host
