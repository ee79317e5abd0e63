// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "pharos/base/units.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

// A connector 8 px wide, turned by 45 deg in the image.
class SmallFace : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(rays_->prepare(camera_.intrinsics));
    scene_.plate_side_m = 0.08;
    scene_.plates = {Vector2(0.66, 0.0)};
  }
  RaisedBox box_turned_by(double turn_rad, const RingModel& ring) const {
    const PlaneAxes axes = axes_of(ring.normal);
    const Vector3 place = truth_.R.col(0) * 0.66;
    RaisedBox box;
    box.rectangle.centre_m = {axes.first.dot(place), axes.second.dot(place)};
    box.rectangle.half_sides_m = {0.043, 0.037};
    box.rectangle.angle_rad = turn_rad;
    box.height_m = scene_.plate_z_m;
    box.base_m = scene_.wall_z_m;
    return box;
  }
  // Modulo a right angle, the nearest.
  static double turn_off_deg(double angle_rad, double from_rad) {
    return std::fabs(std::remainder(angle_rad - from_rad, 0.5 * kPi)) * kDegPerRad;
  }

  test::SyntheticRing scene_;
  DepthCamera camera_ = test::small_camera();
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  test::CameraFromTarget truth_ = test::facing({0.0, 0.0, 3.0}, {0.0, 0.0, 0.25 * kPi});
};

// Boxes of a few cells do not tell their turn.
TEST_F(SmallFace, IsFoundFromAnyTurnOfItsBox) {
  RingFit ring;
  ring.model = {truth_.t, truth_.R.col(2), {scene_.outer_radius_m, scene_.inner_radius_m}};
  ring.amplitude = scene_.ring_grey;
  const auto clean = test::render(scene_, truth_, camera_);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const auto frame = test::with_noise(clean, 50.0, 50.0, seed);
    for (const double turn_rad : {0.0, 0.25 * kPi}) {
      const RaisedBox box = box_turned_by(turn_rad, ring.model);
      const ConnectorFace face = fit_face(frame.view(), camera_, *rays_, ring, box);
      ASSERT_GT(face.edge_points, 0) << seed;
      EXPECT_LT(turn_off_deg(face.rectangle.angle_rad, 0.25 * kPi), 12.0) << seed;
      EXPECT_LT((face.rectangle.centre_m - box.rectangle.centre_m).norm(), 3.0 * std::sqrt(face.covariance.trace()))
          << seed;
    }
  }
}

}  // namespace
}  // namespace pharos::tof
