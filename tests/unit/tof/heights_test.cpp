// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <string>

#include "pharos/tof/frame_check.hpp"
#include "pharos/tof/height_image.hpp"
#include "pharos/tof/relief_image.hpp"
#include "pharos/tof/surroundings.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

const Vector2 kMiddle_px(160.0, 120.0);

// A tilted plane with a square plate of `side_px` that stands `height_m` over it.
class HeightsTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rays_->prepare(camera_.intrinsics)); }
  test::SyntheticFrame plate(int side_px, double height_m) const {
    test::SyntheticFrame frame;
    frame.width_px = camera_.intrinsics.width_px;
    frame.height_px = camera_.intrinsics.height_px;
    for (int v = 0; v < frame.height_px; ++v) {
      for (int u = 0; u < frame.width_px; ++u) {
        const Vector2 ray = *undistort(camera_.intrinsics, Vector2(u, v));
        const double q_ray = kPlane.dot(Vector3(ray.x(), ray.y(), 1.0));
        const bool on = 2.0 * (Vector2(u, v) - kMiddle_px).cwiseAbs().maxCoeff() <= side_px;
        const double z = (1.0 - (on ? height_m : 0.0) * kPlane.norm()) / q_ray;
        frame.depth.push_back(static_cast<std::uint16_t>(z / camera_.depth_scale_m + 0.5));
        frame.intensity.push_back(5000);
      }
    }
    return frame;
  }
  const Vector3 kPlane = Vector3(0.08, -0.15, 1.0) / 3.2;
  const PixelRect kRect{100, 80, 120, 80};
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  std::vector<std::uint16_t> pixels_ = std::vector<std::uint16_t>(120 * 80);
  ImageView<std::uint16_t> heights_{pixels_.data(), 120, 80};
};

TEST_F(HeightsTest, AreThoseOverThePlaneWhateverItsTilt) {
  make_heights(plate(20, 0.06).view(), camera_, *rays_, {kPlane}, kRect, heights_);
  EXPECT_NEAR(height_of(heights_.at(60, 40)), 0.06, 3e-4);
  for (const auto& [u, v] : {std::pair(0, 0), {119, 0}, {0, 79}, {119, 79}}) {
    EXPECT_NEAR(height_of(heights_.at(u, v)), 0.0, 3e-4);
  }
}

TEST_F(HeightsTest, AreNoneWithoutDepthAndFarFromThePlane) {
  test::SyntheticFrame frame = plate(20, kMaxHeight_m + 0.05);
  frame.depth[static_cast<std::size_t>(85 * frame.width_px + 105)] = 0;
  make_heights(frame.view(), camera_, *rays_, {kPlane}, kRect, heights_);
  EXPECT_EQ(heights_.at(60, 40), kNoHeight);
  EXPECT_EQ(heights_.at(5, 5), kNoHeight);
}

Region square_region(int left, int top, int side) {
  Region region;
  region.left = left;
  region.top = top;
  region.right = left + side - 1;
  region.bottom = top + side - 1;
  region.area_px = side * side;
  region.u_px = left + 0.5 * (side - 1);
  region.v_px = top + 0.5 * (side - 1);
  for (int k = 0; k < side; ++k) {
    region.row[static_cast<std::size_t>(k)] = {static_cast<std::int16_t>(left),
                                               static_cast<std::int16_t>(region.right)};
    region.column[static_cast<std::size_t>(k)] = {static_cast<std::int16_t>(top),
                                                  static_cast<std::int16_t>(region.bottom)};
  }
  return region;
}

TEST_F(HeightsTest, SurroundingsAreTheMedianAroundTheRegion) {
  make_heights(plate(20, 0.06).view(), camera_, *rays_, {kPlane}, kRect, heights_);
  const ImageView<const std::uint16_t> heights{pixels_.data(), 120, 80};
  const Surroundings around = surroundings_of(heights, square_region(49, 29, 23));
  EXPECT_NEAR(around.base_m, 0.0, 3e-4);
  EXPECT_LT(around.sigma_m, 5e-4);
  EXPECT_GE(around.samples, kMinSurroundings);
}

TEST_F(HeightsTest, ARegionInEmptySpaceHasNoSurroundings) {
  std::fill(pixels_.begin(), pixels_.end(), kNoHeight);
  const Surroundings around = surroundings_of({pixels_.data(), 120, 80}, square_region(49, 29, 23));
  EXPECT_LT(around.samples, kMinSurroundings);
  EXPECT_EQ(around.base_m, 0.0);
}

TEST_F(HeightsTest, TheFaceIsThePlaneOfMostDepthsAndReliefIsBrightOnThePlateAlone) {
  const test::SyntheticFrame frame = plate(40, 0.1);
  const auto face = face_plane(frame.view(), camera_, *rays_, DepthNoise{});
  ASSERT_TRUE(face);
  EXPECT_LT((face->q - kPlane).norm() / kPlane.norm(), 2e-3);
  std::vector<std::uint16_t> relief(frame.depth.size());
  make_relief_image(frame.view(), camera_, *rays_, *face, {relief.data(), frame.width_px, frame.height_px});
  const auto at = [&](int u, int v) { return relief[static_cast<std::size_t>(v * frame.width_px + u)]; };
  EXPECT_GT(at(160, 120), 20 * std::max<int>(1, at(40, 40)));
}

TEST(FrameCheck, NamesWhatIsWrongWithAFrame) {
  const DepthCamera camera = test::small_camera();
  test::SyntheticFrame frame = test::render({}, test::facing({0.0, 0.0, 2.5}, Vector3::Zero()), camera);
  EXPECT_FALSE(FrameCheck().check(frame.view(), camera));

  test::SyntheticFrame dark = frame;
  std::fill(dark.depth.begin(), dark.depth.end(), std::uint16_t{0});
  EXPECT_EQ(FrameCheck().check(dark.view(), camera), TofFailure::kNoDepth);

  test::SyntheticFrame white = frame;
  std::fill(white.intensity.begin(), white.intensity.end(), std::uint16_t{65535});
  EXPECT_EQ(FrameCheck().check(white.view(), camera), TofFailure::kSaturated);

  DepthCamera other = camera;
  other.intrinsics.width_px = 640;
  EXPECT_EQ(FrameCheck().check(frame.view(), other), TofFailure::kCameraSize);
  EXPECT_EQ(FrameCheck().check({}, camera), TofFailure::kFrameSize);
}

TEST(FrameCheck, RowsThatAreThoseOfTheFrameBeforeAreStale) {
  const DepthCamera camera = test::small_camera();
  const test::SyntheticFrame clean = test::render({}, test::facing({0.0, 0.0, 2.5}, Vector3::Zero()), camera);
  const test::SyntheticFrame first = test::with_noise(clean, 4.0, 20.0, 1);
  test::SyntheticFrame second = test::with_noise(clean, 4.0, 20.0, 2);
  FrameCheck check;
  EXPECT_FALSE(check.check(first.view(), camera));
  const auto half = static_cast<std::ptrdiff_t>(first.depth.size() / 2);
  std::copy(first.depth.begin() + half, first.depth.end(), second.depth.begin() + half);
  std::copy(first.intensity.begin() + half, first.intensity.end(), second.intensity.begin() + half);
  EXPECT_EQ(check.check(second.view(), camera), TofFailure::kStaleRows);
}

TEST(TofFailures, HaveAWordOfTheirOwnAStageAndARemedy) {
  std::set<std::string> words;
  for (int k = 0; k <= static_cast<int>(TofFailure::kRingInconsistent); ++k) {
    const auto failure = static_cast<TofFailure>(k);
    EXPECT_TRUE(words.insert(name_of(failure)).second) << name_of(failure);
    EXPECT_GT(std::string(describe(failure)).size(), 15u);
    const std::string stage = stage_of(failure);
    EXPECT_TRUE(stage == "frame" || stage == "ellipses" || stage == "ring") << stage;
  }
}

}  // namespace
}  // namespace pharos::tof
