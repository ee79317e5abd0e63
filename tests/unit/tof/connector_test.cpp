// SPDX-License-Identifier: Apache-2.0
// The paper's own search: heights, local threshold, regions.
#include "pharos/tof/connector.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "pharos/tof/connector_heights.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::CameraFromTarget;
using test::facing;
using test::SyntheticRing;

class PaperConnectors : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rays_->prepare(camera_.intrinsics));
    fit_.model = {truth_.t, truth_.R.col(2), {scene_.outer_radius_m, scene_.inner_radius_m}};
    fit_.amplitude = scene_.ring_grey;
    fit_.plane_rms_m = 0.003;
  }

  SyntheticRing scene_;
  DepthCamera camera_ = test::small_camera();
  CameraFromTarget truth_ = facing({0.0, 0.0, 2.3}, {0.2, 0.1, 0.5});
  RingFit fit_;
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  std::unique_ptr<ConnectorWorkspace> workspace_ = std::make_unique<ConnectorWorkspace>();
};

TEST_F(PaperConnectors, AreFoundNearestFirstByEitherFormOfTheThreshold) {
  scene_.plates = {Vector2(0.0, 0.72), Vector2(0.66, 0.0)};
  const auto frame = test::with_noise(test::render(scene_, truth_, camera_), 12.0, 40.0, 1);
  for (const ThresholdForm form : {ThresholdForm::kPixelCount, ThresholdForm::kAsPrinted}) {
    ConnectorSettings settings;
    settings.form = form;
    find_connectors(frame.view(), camera_, *rays_, fit_, settings, *workspace_);
    ASSERT_EQ(workspace_->connectors.size(), 2U);
    EXPECT_NEAR(workspace_->connectors[0].distance_m, 0.66, 0.02);
    EXPECT_NEAR(workspace_->connectors[1].distance_m, 0.72, 0.02);
    EXPECT_NEAR(workspace_->connectors[0].height_m, scene_.plate_z_m, 0.005);
  }
}

TEST_F(PaperConnectors, HeightsLeaveTheRingOut) {
  const auto frame = test::render(scene_, truth_, camera_);
  std::vector<std::uint16_t> pixels(static_cast<std::size_t>(kMaxPixels));
  const PixelRect rect{0, 0, frame.width_px, frame.height_px};
  const ImageView<std::uint16_t> heights(pixels.data(), frame.width_px, frame.height_px);
  make_connector_heights(frame.view(), camera_, *rays_, fit_.model, rect, heights);
  const auto at = [&](double along) {
    const Vector2 pixel = *project(camera_.intrinsics, truth_ * Vector3(0.0, along, 0.0));
    return heights.at(static_cast<std::int32_t>(pixel.x()), static_cast<std::int32_t>(pixel.y()));
  };
  EXPECT_EQ(at(0.52), kNoHeight);
  EXPECT_NEAR(height_of(at(0.3)), scene_.wall_z_m, 0.005);
}

}  // namespace
}  // namespace pharos::tof
