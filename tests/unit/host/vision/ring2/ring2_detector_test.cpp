// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring2_detector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "host/support/input_error.hpp"
#include "host/vision/ring2/rim.hpp"
#include "tests/unit/host/vision/ring2/rendered_pair.hpp"

namespace pharos::host {
namespace {

// One pair for all tests, half the usual size, because rendering takes most of the time.
class Ring2DetectorTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scenario_ = new sim::Ring2Scenario(sim::parse_ring2_scenario(
        "poses = [[0.03, -0.02, 2.6, 9.0, -11.0]]\n[rig]\nwidth_px = 640\nheight_px = 512\nfocal_px = 500\n", "pair",
        1));
    images_ = new std::array<GreyImage, 2>(rendered_pair(*scenario_, 0));
  }
  static void TearDownTestSuite() {
    delete images_;
    delete scenario_;
  }
  static Ring2Detection find(const std::array<GreyImage, 2>& images) {
    return Ring2Detector(ring2::core_rig(scenario_->rig), {}).find(views_of(images));
  }
  static std::array<GreyImage, 2> with(std::size_t view, std::uint16_t value) {
    std::array<GreyImage, 2> images = *images_;
    std::fill(images[view].pixels.begin(), images[view].pixels.end(), value);
    return images;
  }

  static sim::Ring2Scenario* scenario_;
  static std::array<GreyImage, 2>* images_;
};
sim::Ring2Scenario* Ring2DetectorTest::scenario_ = nullptr;
std::array<GreyImage, 2>* Ring2DetectorTest::images_ = nullptr;

TEST_F(Ring2DetectorTest, FindsRingAndNozzleInARenderedPair) {
  const Ring2Detection circles = find(*images_);
  ASSERT_TRUE(circles.estimate.has_value()) << circles.refusal;
  const sim::RingAndNozzle truth = scenario_->target_at(0);
  const ring2::Ring2Estimate& e = *circles.estimate;
  EXPECT_EQ(e.ellipses, 4);
  EXPECT_FALSE(e.ambiguous());
  EXPECT_LT(angle_deg(e.normal, truth.normal), 0.1);
  EXPECT_LT((e.ring_centre_m - truth.ring_centre_m).norm(), 0.003);
  EXPECT_NEAR(e.distance_m, truth.distance_m, 0.003);
}

TEST_F(Ring2DetectorTest, ABlackOrSaturatedImageIsNamed) {
  EXPECT_EQ(find(with(0, 300)).refusal, "left_black");
  EXPECT_EQ(find(with(1, 0)).refusal, "right_black");
  EXPECT_EQ(find(with(1, 65535)).refusal, "right_saturated");
  EXPECT_EQ(find(with(0, 30000)).refusal, "left_even");
}

TEST_F(Ring2DetectorTest, ExchangedImagesAreNamed) {
  const Ring2Detection circles = find({(*images_)[1], (*images_)[0]});
  EXPECT_FALSE(circles.estimate.has_value());
  EXPECT_EQ(circles.refusal, "left_right_exchanged");
}

TEST_F(Ring2DetectorTest, ANozzleHiddenFromOneCameraIsDoneWithout) {
  const Ring2Detection all = find(*images_);
  ASSERT_TRUE(all.estimate.has_value());
  auto found = all.found;
  // Removes everything smaller than the ring from the right image.
  std::erase_if(found[1], [&](const ellipse::DetectedEllipse& e) {
    return e.ellipse.a_px < 0.6 * all.contours[1][0]->ellipse.a_px;
  });
  const Ring2Detection three = ring2_among(ring2::core_rig(scenario_->rig), {}, found);
  ASSERT_TRUE(three.estimate.has_value()) << three.refusal;
  EXPECT_EQ(three.estimate->ellipses, 3);
  EXPECT_LT(angle_deg(three.estimate->normal, scenario_->target_at(0).normal), 0.2);
}

// The detected ellipses without those of the size of a ring (of its outer edge, in each view).
std::array<std::vector<ellipse::DetectedEllipse>, 2> without_ring_edges(const Ring2Detection& all, double minimum,
                                                                        double maximum, bool left, bool right) {
  auto found = all.found;
  for (std::size_t v = 0; v < 2; ++v) {
    if (v == 0 ? !left : !right) continue;
    const double outer_px = all.contours[v][0]->ellipse.a_px;
    std::erase_if(found[v], [&](const ellipse::DetectedEllipse& e) {
      return e.ellipse.a_px > minimum * outer_px && e.ellipse.a_px < maximum * outer_px;
    });
  }
  return found;
}

TEST_F(Ring2DetectorTest, TheRingsOuterEdgeInOneImageIsEnoughForItsRadius) {
  const Ring2Detection all = find(*images_);
  ASSERT_TRUE(all.estimate.has_value());
  EXPECT_EQ(all.one_edge & kOneEdgeRing, 0);
  const double truth_m = scenario_->target_at(0).ring_radius_m;
  for (const bool left : {true, false}) {
    const Ring2Detection circles =
        ring2_among(ring2::core_rig(scenario_->rig), {}, without_ring_edges(all, 0.98, 1.2, left, !left));
    ASSERT_TRUE(circles.estimate.has_value()) << circles.refusal;
    const double sigma_m = std::sqrt(circles.estimate->covariance(ring2::kRadius, ring2::kRadius));
    EXPECT_NEAR(circles.estimate->ring_radius_m, truth_m, 0.003);
    EXPECT_NEAR(circles.estimate->ring_radius_m, truth_m, 4.0 * sigma_m);
    EXPECT_LT(sigma_m, 0.002);
    EXPECT_EQ(circles.one_edge & kOneEdgeRing, 0);
  }
}

TEST_F(Ring2DetectorTest, AnOuterEdgeThatIsNoCircleAboutTheCentreSaysSoInItsRadius) {
  const Ring2Detection all = find(*images_);
  ASSERT_TRUE(all.estimate.has_value());
  auto found = without_ring_edges(all, 0.98, 1.2, true, false);
  for (ellipse::DetectedEllipse& e : found[1]) {
    if (e.ellipse.a_px < 0.98 * all.contours[1][0]->ellipse.a_px) continue;
    e.ellipse.cy_px -= 0.6;
    e.ellipse.a_px += 0.4;
    e.ellipse.b_px += 0.4;
  }
  const Ring2Detection circles = ring2_among(ring2::core_rig(scenario_->rig), {}, found);
  ASSERT_TRUE(circles.estimate.has_value()) << circles.refusal;
  const double error_m = std::abs(circles.estimate->ring_radius_m - scenario_->target_at(0).ring_radius_m);
  EXPECT_GT(error_m, 0.001);
  EXPECT_LT(error_m, 2.0 * std::sqrt(circles.estimate->covariance(ring2::kRadius, ring2::kRadius)));
}

TEST_F(Ring2DetectorTest, ALoneInnerEdgeStatesALargeRadiusUncertainty) {
  const Ring2Detection all = find(*images_);
  ASSERT_TRUE(all.estimate.has_value());
  const double truth_m = scenario_->target_at(0).ring_radius_m;
  const Ring2Detection circles =
      ring2_among(ring2::core_rig(scenario_->rig), {}, without_ring_edges(all, 0.98, 1.2, true, true));
  ASSERT_TRUE(circles.estimate.has_value()) << circles.refusal;
  EXPECT_NE(circles.one_edge & kOneEdgeRing, 0);
  const double error_m = std::abs(circles.estimate->ring_radius_m - truth_m);
  EXPECT_GT(error_m, 0.02);
  EXPECT_LT(error_m, 2.0 * std::sqrt(circles.estimate->covariance(ring2::kRadius, ring2::kRadius)));
  EXPECT_LT(angle_deg(circles.estimate->normal, scenario_->target_at(0).normal), 0.2);
}

TEST_F(Ring2DetectorTest, AnotherCamerasImageAndABadRigAreUsageErrors) {
  std::array<GreyImage, 2> images = *images_;
  images[1].height_px -= 2;
  EXPECT_THROW(find(images), InputError);
  ring2::Rig rig = ring2::core_rig(scenario_->rig);
  rig.views[1].T_rig_camera.t = rig.views[0].T_rig_camera.t;
  EXPECT_THROW(Ring2Detector(rig, {}), InputError);
}

}  // namespace
}  // namespace pharos::host
