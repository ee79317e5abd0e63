// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_choice.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "pharos/tof/ring_extent.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::CameraFromTarget;
using test::facing;
using test::SyntheticRing;

class RingChoices : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rays_->prepare(camera_.intrinsics)); }
  ellipse::DetectedEllipse image_of_circle(double radius_m) const {
    const RingModel circle{truth_.t, truth_.R.col(2), {radius_m, radius_m}};
    ellipse::DetectedEllipse found;
    found.ellipse = *image_of(circle, RingEdge::kOuter, camera_.intrinsics);
    return found;
  }
  Result<RingChoice, TofFailure> choose(const test::SyntheticFrame& frame,
                                        std::span<const ellipse::DetectedEllipse> ellipses) const {
    return choose_ring(frame.view(), camera_, *rays_, ellipses, RingSettings{}, DepthNoise{}, *edges_);
  }

  SyntheticRing scene_;
  DepthCamera camera_ = test::small_camera();
  CameraFromTarget truth_ = facing({0.0, 0.0, 2.3}, {0.2, 0.1, 0.5});
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  std::unique_ptr<RingFitWorkspace> edges_ = std::make_unique<RingFitWorkspace>();
};

TEST_F(RingChoices, TakeThePairWithAPlaneBetweenAndAStepBeside) {
  const std::vector<ellipse::DetectedEllipse> found = {image_of_circle(0.75), image_of_circle(0.55),
                                                       image_of_circle(0.49), image_of_circle(0.3)};
  const auto ring = choose(test::render(scene_, truth_, camera_), found);
  ASSERT_TRUE(ring.ok()) << name_of(ring.error());
  EXPECT_NEAR(ring->fit.model.radius(RingEdge::kOuter), 0.55, 0.001);
  EXPECT_NEAR(ring->fit.model.radius(RingEdge::kInner), 0.49, 0.001);
}

TEST_F(RingChoices, FindTheOtherEdgeWhereOneIsMissing) {
  const std::vector<ellipse::DetectedEllipse> found = {image_of_circle(0.55)};
  const auto ring = choose(test::render(scene_, truth_, camera_), found);
  ASSERT_TRUE(ring.ok()) << name_of(ring.error());
  EXPECT_NEAR(ring->fit.model.radius(RingEdge::kInner), 0.49, 0.001);
}

TEST_F(RingChoices, ANearRingMayBeAsNoisyAsItsLightLets) {
  // Shot noise falls with the range, not with its square: 2.8 mm here, where read noise would leave 1.6.
  truth_ = facing({0.0, 0.0, 1.98}, {0.05, 0.05, 0.5});
  const std::vector<ellipse::DetectedEllipse> found = {image_of_circle(0.55), image_of_circle(0.49)};
  const auto frame = test::with_noise(test::render(scene_, truth_, camera_), 14.0, 40.0, 1);
  const auto ring = choose(frame, found);
  EXPECT_TRUE(ring.ok()) << name_of(ring.error());
}

TEST_F(RingChoices, OfNoEllipsesThereIsNone) {
  const auto ring = choose(test::render(scene_, truth_, camera_), {});
  ASSERT_FALSE(ring.ok());
  EXPECT_EQ(ring.error(), TofFailure::kNoEllipses);
}

TEST(TofStages, HaveAWordOfTheirOwn) {
  std::set<std::string> words;
  for (std::size_t k = 0; k < kTofStages; ++k) words.insert(name_of(static_cast<TofStage>(k)));
  EXPECT_EQ(words.size(), kTofStages);
}

}  // namespace
}  // namespace pharos::tof
