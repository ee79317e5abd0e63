// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/depth_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

// Depths of one plane in the whole image, with noise; amplitude is the same everywhere.
test::SyntheticFrame plane_frame(const DepthCamera& camera, const Vector3& q, double sigma_m, unsigned seed) {
  test::SyntheticFrame frame;
  frame.width_px = camera.intrinsics.width_px;
  frame.height_px = camera.intrinsics.height_px;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, sigma_m);
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      const Vector2 ray = *undistort(camera.intrinsics, Vector2(u, v));
      const double z = 1.0 / q.dot(Vector3(ray.x(), ray.y(), 1.0)) + normal(random);
      frame.depth.push_back(static_cast<std::uint16_t>(z / camera.depth_scale_m + 0.5));
      frame.intensity.push_back(5000);
    }
  }
  return frame;
}

const ellipse::Ellipse kOuter{160.0, 120.0, 60.0, 55.0, 0.3};
const ellipse::Ellipse kInner{160.0, 120.0, 53.0, 48.5, 0.3};
const Vector3 kPlane = Vector3(0.1, -0.2, 1.0) / 3.5;

class DepthPlaneTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rays_->prepare(camera_.intrinsics)); }
  std::optional<PlaneFit> fit(const test::SyntheticFrame& frame) const {
    return fit_plane(frame.view(), camera_, *rays_, ring_region(kInner, kOuter));
  }
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
};

TEST_F(DepthPlaneTest, GridOfRaysIsThatOfTheLens) {
  double worst = 0.0;
  for (int v = 0; v < 240; v += 3) {
    for (int u = 0; u < 320; u += 3) {
      worst = std::max(worst, (rays_->at(u, v) - *undistort(camera_.intrinsics, Vector2(u, v))).norm());
    }
  }
  // Nodes are twice as far apart, in angle, as at 640 columns: four times the error in angle, twice in pixels.
  EXPECT_LT(worst * camera_.intrinsics.fx_px, 0.02) << "px";
}

TEST_F(DepthPlaneTest, RowsOfRaysAreThoseOfThePixels) {
  RayGrid::Row<float> row;
  RayGrid::Row<double> exact;
  for (const int u : {0, 1, 3, 5, 318}) {
    for (int v = 0; v < 240; ++v) {
      const int count = std::min(320 - u, 150);
      rays_->row_at(u, v, count, row);
      rays_->row_at(u, v, count, exact);
      for (int k = 0; k < count; ++k) {
        const Vector2 ray(row.x()[k], row.y()[k]);
        const Vector2 of_pixel = rays_->at(u + k, v);
        ASSERT_LT((ray - of_pixel).norm() * camera_.intrinsics.fx_px, 1e-4) << u + k << ", " << v << ", px";
        ASSERT_EQ(Vector2(exact.x()[k], exact.y()[k]), of_pixel) << u + k << ", " << v;
      }
    }
  }
}

TEST_F(DepthPlaneTest, NoiselessDepthsGiveTheirPlane) {
  const auto plane = fit(plane_frame(camera_, kPlane, 0.0, 1));
  ASSERT_TRUE(plane.has_value());
  // The grid of rays leaves some 0.005 px, which is 0.02 mm of depth on a plane of this slope.
  EXPECT_LT((plane->plane.q - kPlane).norm(), 2e-6);
  EXPECT_GT(plane->inlier_fraction, 0.99);
}

TEST_F(DepthPlaneTest, CovarianceIsThatOfTheErrors) {
  double squares = 0.0;
  constexpr int kFrames = 60;
  for (unsigned seed = 0; seed < kFrames; ++seed) {
    const auto plane = fit(plane_frame(camera_, kPlane, 0.005, seed));
    ASSERT_TRUE(plane.has_value());
    const Vector3 error = plane->plane.q - kPlane;
    squares += error.dot(plane->information * error);
    EXPECT_NEAR(plane->rms_m, 0.005, 0.0006);
  }
  EXPECT_NEAR(squares / (3.0 * kFrames), 1.0, 0.35);
}

TEST_F(DepthPlaneTest, AThirdHiddenByABoomAndFlyingPixelsDoNotMoveIt) {
  test::SyntheticFrame frame = plane_frame(camera_, kPlane, 0.005, 4);
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      std::uint16_t& counts = frame.depth[static_cast<std::size_t>(v * frame.width_px + u)];
      if (u > 190) counts = static_cast<std::uint16_t>(counts * 8 / 10);
      if ((u + 7 * v) % 13 == 0) counts = static_cast<std::uint16_t>(counts + 200);
      if ((u + 5 * v) % 17 == 0) counts = 0;
    }
  }
  const auto plane = fit(frame);
  ASSERT_TRUE(plane.has_value());
  const Vector3 error = plane->plane.q - kPlane;
  EXPECT_LT(error.dot(plane->information * error), 25.0);
  EXPECT_LT(plane->inlier_fraction, 0.75);
}

TEST_F(DepthPlaneTest, NeighboursCommonNoiseIsCounted) {
  // Noise that is constant over blocks of 4 x 4 pixels: an average is sixteen times as uncertain as its pixels suggest.
  test::SyntheticFrame frame = plane_frame(camera_, kPlane, 0.0, 1);
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal(0.0, 20.0);
  std::vector<double> block(80 * 60);
  for (double& value : block) value = normal(random);
  for (std::int32_t v = 0; v < frame.height_px; ++v) {
    for (std::int32_t u = 0; u < frame.width_px; ++u) {
      std::uint16_t& counts = frame.depth[static_cast<std::size_t>(v * frame.width_px + u)];
      counts = static_cast<std::uint16_t>(counts + block[static_cast<std::size_t>(v / 4 * 80 + u / 4)]);
    }
  }
  const auto plane = fit(frame);
  ASSERT_TRUE(plane.has_value());
  EXPECT_GT(plane->variance_inflation, 7.0);
  EXPECT_LT(plane->variance_inflation, 25.0);
}

TEST_F(DepthPlaneTest, TooFewDepthsGiveNone) {
  test::SyntheticFrame frame = plane_frame(camera_, kPlane, 0.005, 2);
  std::fill(frame.depth.begin(), frame.depth.end(), std::uint16_t{0});
  EXPECT_FALSE(fit(frame).has_value());
  std::fill(frame.depth.begin(), frame.depth.end(), std::uint16_t{65535});
  EXPECT_FALSE(fit(frame).has_value());
}

}  // namespace
}  // namespace pharos::tof
