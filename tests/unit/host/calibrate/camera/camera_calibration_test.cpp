// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/camera_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "board_truth.hpp"

namespace pharos::calibrate {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<ImageOutcome> images_at(const std::vector<CameraFromBoard>& poses, const Board& board, double sigma_px,
                                    std::uint64_t seed) {
  std::vector<ImageOutcome> images;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    images.push_back(image_of(observed(sim::kPaperLens, poses[i], board, sigma_px, 1000 * seed + i)));
  }
  return images;
}

CameraCalibration calibrated(const std::vector<CameraFromBoard>& poses, double sigma_px, std::uint64_t seed,
                             bool fix_k3 = true) {
  return calibrate_camera(images_at(poses, {}, sigma_px, seed), sim::kPaperLens.width_px, sim::kPaperLens.height_px,
                          {{}, fix_k3});
}

CameraCalibration calibrated_from_renders(const sim::BoardSheet& sheet, const CalibrationChoices& choices, int count,
                                          const sim::Exposure& exposure) {
  static const sim::BoardRenderer renderer(sim::kPaperLens);
  std::vector<host::GreyImage> images;
  for (const CameraFromBoard& T : sim::board_poses(sim::kPaperLens, sheet, count, 3)) {
    images.push_back(renderer.render(sheet, T, exposure, images.size()));
  }
  std::vector<BoardPicture> pictures;
  for (const host::GreyImage& image : images) pictures.push_back({std::to_string(pictures.size()), image.view()});
  return calibrate_camera(pictures, choices);
}

TEST(CameraCalibration, RenderedDotsGiveTheLensWithinItsCovariance) {
  sim::Exposure exposure;
  exposure.noise = 280.0;
  exposure.falloff = 0.3;
  const CameraCalibration result = calibrated_from_renders({}, {{}, true}, 6, exposure);
  ASSERT_EQ(result.refusal, "");
  EXPECT_LT(errors_of(*result.outcome, sim::kPaperLens, true).largest, 3.0);
  EXPECT_LT(result.outcome->rms_px, 0.012);
  EXPECT_NEAR(result.outcome->noise_ratio, 1.0, 0.2);
  EXPECT_NEAR(result.outcome->area_ratio, 1.0, 0.03);
}

TEST(CameraCalibration, RenderedChessboardsGiveTheLensWithinTheirCovariance) {
  sim::BoardSheet sheet;
  sheet.dots = false;
  CalibrationChoices choices;
  choices.board.kind = BoardKind::kChessboard;
  choices.fix_k3 = true;
  sim::Exposure exposure;
  exposure.noise = 280.0;
  const CameraCalibration result = calibrated_from_renders(sheet, choices, 5, exposure);
  ASSERT_EQ(result.refusal, "");
  EXPECT_LT(errors_of(*result.outcome, sim::kPaperLens, true).largest, 3.0);
  EXPECT_LT(result.outcome->rms_px, 0.1);
}

TEST(CameraCalibration, ErrorsFollowTheStatedCovariance) {
  double nees = 0.0;
  constexpr int kSets = 30;
  for (int set = 0; set < kSets; ++set) {
    const auto seed = static_cast<std::uint64_t>(set);
    const CameraCalibration result = calibrated(sim::board_poses(sim::kPaperLens, {}, 5, seed), 0.02, seed, false);
    ASSERT_TRUE(result.outcome);
    nees += errors_of(*result.outcome, sim::kPaperLens, false).nees / kSets;
  }
  EXPECT_NEAR(nees, 1.0, 3.0 * std::sqrt(2.0 / (9.0 * kSets)));  // 3 sigma of a mean of chi squares
}

TEST(CameraCalibration, FixesK3AtZeroOnRequestAndReportsIt) {
  const CameraCalibration result = calibrated(sim::board_poses(sim::kPaperLens, {}, 6, 1), 0.01, 1);
  ASSERT_EQ(result.refusal, "");
  EXPECT_EQ(result.camera().distortion[4], 0.0);
  EXPECT_EQ(result.outcome->parameters.size(), 8U);
  EXPECT_THAT(result.unobservable, Contains(HasSubstr("k3 was held")));
}

TEST(CameraCalibration, RefusesBoardsThatAllFaceTheCamera) {
  std::vector<CameraFromBoard> poses;
  for (const double x : {-0.05, 0.0, 0.05}) {
    for (const double z : {0.3, 0.4, 0.5})
      poses.push_back(sim::board_at({}, {x, 0.2 * x, z}, Vector3::Zero(), 2.0 * x));
  }
  const CameraCalibration result = calibrated(poses, 0.01, 2);
  EXPECT_NE(result.refusal, "");
}

TEST(CameraCalibration, RefusesBoardsThatAreParallelThoughTilted) {
  std::vector<CameraFromBoard> poses;
  for (const double x : {-0.03, 0.0, 0.03}) {
    for (const double z : {0.35, 0.45}) poses.push_back(sim::board_at({}, {x, -x, z}, {0.4, 0.2, 0.0}));
  }
  EXPECT_THAT(calibrated(poses, 0.01, 3).refusal, HasSubstr("parallel within"));
}

TEST(CameraCalibration, RefusesOnePoseRepeated) {
  const std::vector<CameraFromBoard> poses(8, sim::board_at({}, {0.0, 0.0, 0.35}, {0.4, -0.3, 0.0}));
  EXPECT_THAT(calibrated(poses, 0.01, 4).refusal, HasSubstr("one pose in all images"));
}

TEST(CameraCalibration, RefusesTooFewImages) {
  EXPECT_THAT(calibrated(sim::board_poses(sim::kPaperLens, {}, 2, 5), 0.01, 5).refusal,
              HasSubstr("2 of 2 images show the whole board; at least 3"));
  EXPECT_THAT(calibrate_camera(std::vector<BoardPicture>{}, {}).refusal, HasSubstr("0 of 0 images"));
}

TEST(CameraCalibration, SaysWhichPartOfTheImageHasNoPoints) {
  std::vector<CameraFromBoard> poses;  // the board is only in the left half
  for (const double tilt : {-0.5, -0.2, 0.1, 0.3, 0.5}) {
    poses.push_back(sim::board_at({}, {-0.2, 0.1 * tilt, 0.8}, {tilt, 0.3 - tilt, 0.0}));
  }
  const CameraCalibration result = calibrated(poses, 0.05, 6, false);
  EXPECT_THAT(result.coverage.uncovered, Contains("right"));
  EXPECT_THAT(result.coverage.uncovered, Contains("upper right"));
  EXPECT_THAT(result.coverage.uncovered, testing::Not(Contains("left")));
  EXPECT_THAT(result.unobservable, Contains(HasSubstr("no point in this part of the image: upper right")));
  EXPECT_THAT(result.unobservable, Contains(HasSubstr("distortion in the corners")));
}

TEST(CameraCalibration, NamesAnImageOfAnotherSizeAndUsesTheRest) {
  std::vector<std::uint16_t> large(64 * 48), small(32 * 24);
  const CameraCalibration result = calibrate_camera({{"a", {large.data(), 64, 48}}, {"b", {small.data(), 32, 24}}}, {});
  ASSERT_EQ(result.images.size(), 2U);
  EXPECT_EQ(result.images[0].search.status, ImageStatus::kNoBoard);
  EXPECT_EQ(result.images[1].search.status, ImageStatus::kOtherSize);
  EXPECT_EQ(result.images[1].search.detail, "32 x 24 px, the first image has 64 x 48");
}

TEST(CameraCalibration, ReportsThatDotsHaveAnotherRadiusThanGiven) {
  sim::BoardSheet sheet;
  sheet.radius_m = 0.006;
  const CameraCalibration result = calibrated_from_renders(sheet, {{}, true}, 4, {});
  ASSERT_TRUE(result.outcome);
  EXPECT_NEAR(std::sqrt(result.outcome->area_ratio), 1.2, 0.02);
}

}  // namespace
}  // namespace pharos::calibrate
