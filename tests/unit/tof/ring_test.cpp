// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "pharos/tof/ring_edges.hpp"
#include "pharos/tof/ring_extent.hpp"
#include "pharos/tof/ring_fit.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

// The ring of the synthetic scene, tilted; its model is known to the last digit.
class RingTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rays_->prepare(camera_.intrinsics));
    truth_.centre_m = T_camera_target_.t;
    truth_.normal = T_camera_target_.R.col(2);
    truth_.radius_m = {scene_.outer_radius_m, scene_.inner_radius_m};
  }
  RingModel off_by(double shift_m, double growth_m) const {
    RingModel model = truth_;
    const PlaneAxes axes = axes_of(truth_.normal);
    model.centre_m += shift_m * (axes.first + axes.second);
    for (double& radius : model.radius_m) radius += growth_m;
    return model;
  }
  test::SyntheticRing scene_;
  DepthCamera camera_ = test::small_camera();
  test::CameraFromTarget T_camera_target_ = test::facing({0.1, -0.05, 2.4}, {0.25, -0.15, 0.0});
  test::SyntheticFrame frame_ = test::render(scene_, T_camera_target_, camera_);
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  RingModel truth_;
};

TEST_F(RingTest, AxesOfItsPlaneAreAnOrthonormalBasis) {
  const PlaneAxes axes = axes_of(truth_.normal);
  EXPECT_NEAR(axes.first.dot(truth_.normal), 0.0, 1e-12);
  EXPECT_NEAR(axes.first.dot(axes.second), 0.0, 1e-12);
  EXPECT_NEAR(axes.second.norm(), 1.0, 1e-12);
  EXPECT_NEAR(truth_.plane().q.dot(truth_.centre_m), 1.0, 1e-12);
}

TEST_F(RingTest, TheImageOfACircleIsWhereItsPointsProject) {
  const auto image = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
  ASSERT_TRUE(image);
  const PlaneAxes axes = axes_of(truth_.normal);
  const Vector3 point = truth_.centre_m + truth_.radius(RingEdge::kOuter) * axes.first;
  const auto pixel = project(camera_.intrinsics, point);
  ASSERT_TRUE(pixel);
  const Vector2 off = *pixel - Vector2(image->cx_px, image->cy_px);
  const double along = off.x() * std::cos(image->theta_rad) + off.y() * std::sin(image->theta_rad);
  const double across = -off.x() * std::sin(image->theta_rad) + off.y() * std::cos(image->theta_rad);
  EXPECT_NEAR(std::hypot(along / image->a_px, across / image->b_px), 1.0, 0.02);  // the lens bends it a little
}

TEST_F(RingTest, EdgesAreFoundAtTheirOffsetFromTheModel) {
  const RingPrior prior{0.02, scene_.ring_grey, 0.02};
  const double px_per_m = camera_.intrinsics.fx_px / truth_.centre_m.z();
  for (const double growth_m : {-0.008, 0.0, 0.008}) {
    RingEdgePoints points;
    const double seen =
        find_ring_edges(frame_.view(), camera_, *rays_, off_by(0.0, growth_m), RingEdge::kOuter, 4.0, prior, points);
    EXPECT_GT(seen, 0.8);
    ASSERT_GT(points.size(), 100u);
    double mean = 0.0;
    for (const RingEdgePoint& point : points) mean += point.offset_px / static_cast<double>(points.size());
    EXPECT_NEAR(mean, -growth_m * px_per_m, 0.12) << growth_m;
  }
}

TEST_F(RingTest, TheFitComesBackToTheTruthFromAModelThatIsOff) {
  const RingModel start = off_by(0.006, 0.005);
  const auto outer = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
  const auto inner = image_of(truth_, RingEdge::kInner, camera_.intrinsics);
  ASSERT_TRUE(outer && inner);
  const auto plane = fit_plane(frame_.view(), camera_, *rays_, ring_region(*inner, *outer));
  ASSERT_TRUE(plane);
  const auto workspace = std::make_unique<RingFitWorkspace>();
  const auto fit = fit_ring(frame_.view(), camera_, *rays_, *plane, start, 0.02, DepthNoise{}, *workspace);
  ASSERT_TRUE(fit);
  EXPECT_LT((fit->model.centre_m - truth_.centre_m).norm(), 1e-3);
  EXPECT_LT(std::acos(std::min(1.0, fit->model.normal.dot(truth_.normal))), 2e-3);
  EXPECT_NEAR(fit->model.radius(RingEdge::kOuter), 0.55, 1e-3);
  EXPECT_NEAR(fit->model.radius(RingEdge::kInner), 0.49, 1e-3);
  EXPECT_GT(fit->seen, 0.8);
  const Matrix7 symmetric = fit->covariance - fit->covariance.transpose();
  EXPECT_LT(symmetric.norm(), 1e-12);
  EXPECT_GT(fit->covariance.diagonal().minCoeff(), 0.0);
}

TEST_F(RingTest, ARingOnThePlaneThroughTwoImagesHasTheirRadii) {
  const auto outer = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
  const auto inner = image_of(truth_, RingEdge::kInner, camera_.intrinsics);
  ASSERT_TRUE(outer && inner);
  const auto ring = ring_on_plane(truth_.plane(), *rays_, *outer, *inner);
  ASSERT_TRUE(ring);
  EXPECT_NEAR(ring->radius(RingEdge::kOuter), 0.55, 3e-3);
  EXPECT_NEAR(ring->radius(RingEdge::kInner), 0.49, 3e-3);
  EXPECT_LT((ring->centre_m - truth_.centre_m).norm(), 5e-3);
}

TEST_F(RingTest, OneEdgeAndTheDepthsGiveTheOther) {
  const auto outer = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
  ASSERT_TRUE(outer);
  const auto ring = ring_from_one_edge(frame_.view(), camera_, *rays_, *outer, RingEdge::kOuter, 0.7);
  ASSERT_TRUE(ring);
  const double pixel_m = truth_.centre_m.z() / camera_.intrinsics.fx_px;
  EXPECT_NEAR(ring->radius(RingEdge::kInner), 0.49, 1.5 * pixel_m);
}

TEST_F(RingTest, ARingPaintedOnAWallHasNoEnd) {
  scene_.wall_z_m = 0.0;
  frame_ = test::render(scene_, T_camera_target_, camera_);
  const auto outer = image_of(truth_, RingEdge::kOuter, camera_.intrinsics);
  ASSERT_TRUE(outer);
  EXPECT_FALSE(ring_from_one_edge(frame_.view(), camera_, *rays_, *outer, RingEdge::kOuter, 0.7));
}

TEST_F(RingTest, ThePlanesExtentGivesBothRadiiToAPixel) {
  const auto ring = ring_from_plane_extent(frame_.view(), camera_, *rays_, off_by(0.0, 0.02), 0.02);
  ASSERT_TRUE(ring);
  const double pixel_m = truth_.centre_m.z() / camera_.intrinsics.fx_px;
  EXPECT_NEAR(ring->radius(RingEdge::kOuter), 0.55, 1.5 * pixel_m);
  EXPECT_NEAR(ring->radius(RingEdge::kInner), 0.49, 1.5 * pixel_m);
}

}  // namespace
}  // namespace pharos::tof
