// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/other_ring.hpp"

#include <gtest/gtest.h>

namespace pharos::host {
namespace {

using ellipse::DetectedEllipse;

using Found = std::array<std::vector<DetectedEllipse>, ring2::kViews>;

ring2::Rig rig() {
  ring2::Rig rig;
  for (ring2::RigView& view : rig.views) {
    view.intrinsics.fx_px = view.intrinsics.fy_px = 1000.0;
    view.intrinsics.cx_px = view.intrinsics.cy_px = 500.0;
    view.intrinsics.width_px = view.intrinsics.height_px = 1000;
  }
  rig.views[1].T_rig_camera.t = {0.5, 0.0, 0.0};
  return rig;
}

// 3 m ahead: centre (500, 500) in the left image, radius 100 px.
ring2::Ring2Estimate chosen() {
  ring2::Ring2Estimate estimate;
  estimate.ring_centre_m = {0.0, 0.0, 3.0};
  estimate.normal = {0.0, 0.0, -1.0};
  estimate.ring_radius_m = 0.3;
  return estimate;
}

DetectedEllipse ellipse_at(double cx_px, double cy_px, double a_px, double b_px) {
  DetectedEllipse found;
  found.ellipse = {cx_px, cy_px, a_px, b_px, 0.0};
  return found;
}

bool shows(const std::vector<DetectedEllipse>& left, const std::vector<DetectedEllipse>& right = {}) {
  return shows_another_ring(rig(), Found{left, right}, chosen());
}

TEST(OtherRing, IsAFaceBesideTheChosenRing) {
  EXPECT_TRUE(shows({ellipse_at(750, 500, 95, 90), ellipse_at(750.5, 500, 85, 80)}));
}

TEST(OtherRing, IsEnoughInOneImage) {
  // The chosen ring is at (333, 500) in the right image.
  EXPECT_TRUE(shows({}, {ellipse_at(600, 500, 110, 100), ellipse_at(600, 500, 100, 91)}));
}

TEST(OtherRing, HasTwoEdges) {
  EXPECT_FALSE(shows({ellipse_at(750, 500, 95, 90)}));
  EXPECT_FALSE(shows({ellipse_at(750, 500, 95, 90), ellipse_at(750, 500, 50, 47)}));  // a nozzle, not a rim
  EXPECT_FALSE(shows({ellipse_at(750, 500, 95, 90), ellipse_at(756, 500, 85, 80)}));  // not concentric
}

TEST(OtherRing, IsAboutAsLarge) { EXPECT_FALSE(shows({ellipse_at(750, 500, 60, 55), ellipse_at(750, 500, 54, 49.5)})); }

TEST(OtherRing, IsNotOnTheChosenRingsAxis) {
  EXPECT_FALSE(shows({ellipse_at(500, 500, 100, 95), ellipse_at(500, 500, 90, 85.5)}));   // its own face
  EXPECT_FALSE(shows({ellipse_at(530, 500, 180, 170), ellipse_at(530, 500, 165, 156)}));  // a round body's edge
}

}  // namespace
}  // namespace pharos::host
