// SPDX-License-Identifier: Apache-2.0
// The thirteen pairs of a 9 x 6 chessboard in Debian's opencv-doc.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "host/calibrate/camera/rig_calibration.hpp"

namespace pharos::calibrate {
namespace {

constexpr const char* kFolder = "/usr/share/doc/opencv-doc/examples/data/";

struct Pictures {
  std::vector<cv::Mat> images;
  std::vector<BoardPicture> pictures;
};

Pictures pictures_of(const std::string& side) {
  Pictures result;
  std::vector<std::string> names;
  for (const int number : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14}) {
    names.push_back(side + (number < 10 ? "0" : "") + std::to_string(number) + ".jpg");
    cv::Mat wide;
    cv::imread(kFolder + names.back(), cv::IMREAD_GRAYSCALE).convertTo(wide, CV_16U, 257.0);
    result.images.push_back(wide);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const cv::Mat& image = result.images[i];
    result.pictures.push_back({names[i], {image.ptr<std::uint16_t>(), image.cols, image.rows}});
  }
  return result;
}

TEST(RealPairs, FitAsWellAsOpencvsOwnAdjustment) {
  if (!std::filesystem::exists(std::string(kFolder) + "left01.jpg")) {
    GTEST_SKIP() << "no real pairs: install Debian's opencv-doc (tools/install-dependencies test)";
  }
  const Pictures left = pictures_of("left"), right = pictures_of("right");
  const Board board{BoardKind::kChessboard, 9, 6, 0.025, 0.0};
  const RigCalibration rig = calibrate_rig(left.pictures, right.pictures, {board, false});
  for (const auto& side : rig.images) {
    for (const ImageOutcome& image : side) {
      std::printf("%s %s %.3f px %s\n", image.name.c_str(), name_of(image.search.status), image.rms_px,
                  image.search.detail.c_str());
    }
  }
  ASSERT_EQ(rig.refusal, "");
  EXPECT_EQ(rig.pairs, 13U);
  std::printf("rms %.4f px, OpenCV %.4f; epipolar rms %.4f px, OpenCV %.4f\n", rig.outcome->rms_px, rig.opencv_rms_px,
              rig.epipolar_rms_px, rig.opencv_epipolar_rms_px);
  EXPECT_LT(rig.outcome->rms_px, 1.001 * rig.opencv_rms_px);
  EXPECT_LT(rig.epipolar_rms_px, 1.02 * rig.opencv_epipolar_rms_px);
  EXPECT_LT(rig.epipolar_rms_px, 0.35);

  const CameraCalibration alone = calibrate_camera(rig.images[0], 640, 480, {board, false});
  ASSERT_TRUE(alone.outcome);
  std::printf("left camera alone: rms %.4f px, OpenCV %.4f, fx %.2f +- %.2f\n", alone.outcome->rms_px,
              alone.opencv_rms_px, alone.camera().fx_px, std::sqrt(alone.outcome->covariance(0, 0)));
  EXPECT_LT(alone.outcome->rms_px, 1.001 * alone.opencv_rms_px);
  EXPECT_NEAR(alone.camera().fx_px, 535.9, 5.0);  // opencv-doc's left_intrinsics.yml, from another corner detector
}

}  // namespace
}  // namespace pharos::calibrate
