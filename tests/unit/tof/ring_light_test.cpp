// SPDX-License-Identifier: Apache-2.0
// Rings of which no pixel is the ring's alone: narrow ones, and a lens out of focus.
#include "pharos/tof/ring_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "pharos/tof/ring_extent.hpp"
#include "pharos/tof/ring_fit.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

// Light, and light times depth, spread by a Gaussian: what a lens out of focus does to either image.
test::SyntheticFrame out_of_focus(const test::SyntheticFrame& sharp, double sigma_px) {
  const int width = sharp.width_px, height = sharp.height_px, reach = static_cast<int>(std::ceil(4.0 * sigma_px));
  std::vector<double> light(sharp.intensity.begin(), sharp.intensity.end()), moment(light.size());
  for (std::size_t i = 0; i < light.size(); ++i) moment[i] = light[i] * sharp.depth[i];
  const auto spread = [&](std::vector<double>& image, int du, int dv) {
    const std::vector<double> before = image;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        double sum = 0.0, weights = 0.0;
        for (int k = -reach; k <= reach; ++k) {
          const int x = std::clamp(u + k * du, 0, width - 1), y = std::clamp(v + k * dv, 0, height - 1);
          const double weight = std::exp(-0.5 * k * k / (sigma_px * sigma_px));
          sum += weight * before[static_cast<std::size_t>(y * width + x)];
          weights += weight;
        }
        image[static_cast<std::size_t>(v * width + u)] = sum / weights;
      }
    }
  };
  for (std::vector<double>* image : {&light, &moment}) {
    spread(*image, 1, 0);
    spread(*image, 0, 1);
  }
  test::SyntheticFrame result = sharp;
  for (std::size_t i = 0; i < light.size(); ++i) {
    result.intensity[i] = static_cast<std::uint16_t>(light[i] + 0.5);
    result.depth[i] = static_cast<std::uint16_t>(moment[i] / light[i] + 0.5);
  }
  return result;
}

class RingLightTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rays_->prepare(camera_.intrinsics));
    scene_.wall_grey = 3500.0;
    scene_.plates.clear();
  }
  // Means of the fits of a few noisy frames, from a start that is a third of a pixel off.
  RingFit mean_fit(double inner_radius_m, double sigma_px) {
    scene_.inner_radius_m = inner_radius_m;
    const auto pose = test::facing({0.05, -0.05, 2.4}, {0.16, -0.1, 0.0});
    const auto sharp = test::render(scene_, pose, camera_);
    const auto clean = sigma_px > 0.0 ? out_of_focus(sharp, sigma_px) : sharp;
    truth_ = {pose.t, pose.R.col(2), {scene_.outer_radius_m, scene_.inner_radius_m}};
    const auto outer = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
    const auto inner = image_of(truth_, RingEdge::kInner, camera_.intrinsics);
    RingModel start = truth_;
    start.centre_m.x() += 0.002;
    constexpr int kFrames = 6;
    RingFit mean;
    mean.model = {Vector3::Zero(), Vector3::Zero(), {0.0, 0.0}};
    for (unsigned seed = 1; seed <= kFrames; ++seed) {
      const auto frame = test::with_noise(clean, 6.0, 30.0, seed);
      const auto plane = fit_plane(frame.view(), camera_, *rays_, ring_region(*inner, *outer));
      EXPECT_TRUE(plane);
      if (!plane) return mean;
      const auto fit = fit_ring(frame.view(), camera_, *rays_, *plane, start, 0.02, DepthNoise{}, *workspace_);
      EXPECT_TRUE(fit);
      if (!fit) return mean;
      mean.model.centre_m += fit->model.centre_m / kFrames;
      for (std::size_t e = 0; e < 2; ++e) mean.model.radius_m[e] += fit->model.radius_m[e] / kFrames;
      mean.covariance = fit->covariance;
      mean.walls.ratio += (fit->walls.ratio - mean.walls.ratio) / seed;
      mean.walls.variance = fit->walls.variance;
    }
    return mean;
  }
  // Of an edge in the image.
  double radius_px(const RingModel& model, std::size_t edge) const {
    return camera_.intrinsics.fx_px * model.radius_m[edge] / model.centre_m.z();
  }

  test::SyntheticRing scene_;
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  std::unique_ptr<RingFitWorkspace> workspace_ = std::make_unique<RingFitWorkspace>();
  RingModel truth_;
};

// Three pixels from edge to edge: the steepest points of its light are a seventh of a pixel too far apart.
TEST_F(RingLightTest, EdgesOfANarrowRingDoNotPushOneAnotherApart) {
  const RingFit fit = mean_fit(0.526, 0.0);
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_NEAR(radius_px(fit.model, e), radius_px(truth_, e), 0.05) << e;
  }
  const Vector3 off_m = fit.model.centre_m - truth_.centre_m;
  EXPECT_LT(off_m.head<2>().norm() * camera_.intrinsics.fx_px / truth_.centre_m.z(), 0.03);
}

TEST_F(RingLightTest, ALensOutOfFocusMovesNeitherEdge) {
  const RingFit fit = mean_fit(0.516, 1.0);
  for (std::size_t e = 0; e < 2; ++e) {
    EXPECT_NEAR(radius_px(fit.model, e), radius_px(truth_, e), 0.05) << e;
  }
  EXPECT_NEAR(workspace_->light.blur_px, 1.04, 0.1);  // the pixel's own 0.29 px included
}

// What connectors a few pixels wide do not show of their own walls.
TEST_F(RingLightTest, TellsHowBrightItsWallsAre) {
  scene_.has_ring_walls = true;
  for (const double light : {0.3, 1.0}) {
    scene_.wall_light = light;
    const RingFit fit = mean_fit(0.49, 0.0);
    EXPECT_NEAR(fit.walls.ratio, light, 0.15);
    EXPECT_LT(std::sqrt(fit.walls.variance), 0.2);
  }
}

}  // namespace
}  // namespace pharos::tof
