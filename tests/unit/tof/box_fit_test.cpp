// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/box_fit.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "pharos/base/units.hpp"
#include "pharos/tof/raised_box.hpp"
#include "support/synthetic_ring.hpp"

namespace pharos::tof {
namespace {

using test::CameraFromTarget;
using test::facing;
using test::SyntheticRing;

// The ring as it is, as measure_tof_pose would find it.
class BoxFits : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(rays_->prepare(camera_.intrinsics)); }
  void find(const SyntheticRing& scene, const CameraFromTarget& truth) {
    fit_.model = {truth.t, truth.R.col(2), {scene.outer_radius_m, scene.inner_radius_m}};
    fit_.amplitude = scene.ring_grey;
    const auto frame = test::with_noise(test::render(scene, truth, camera_), 16.0, 40.0, 1);
    find_raised_boxes(frame.view(), camera_, *rays_, fit_, ConnectorSettings{}, *workspace_);
  }
  // Of T in the axes of the boxes.
  Vector2 planar(const CameraFromTarget& truth, const Vector2& place) const {
    const PlaneAxes axes = axes_of(truth.R.col(2));
    const Vector3 p = truth.R * Vector3(place.x(), place.y(), 0.0);
    return {axes.first.dot(p), axes.second.dot(p)};
  }

  DepthCamera camera_ = test::small_camera();
  RingFit fit_;
  std::unique_ptr<RayGrid> rays_ = std::make_unique<RayGrid>();
  std::unique_ptr<RaisedWorkspace> workspace_ = std::make_unique<RaisedWorkspace>();
};

TEST_F(BoxFits, FindPlaceSizeAndHeightWhateverTheTilt) {
  const SyntheticRing scene;
  for (const double tilt : {0.0, 0.3, 0.6}) {
    const CameraFromTarget truth = facing({0.0, 0.05, 2.3}, {tilt, 0.0, 0.8});
    find(scene, truth);
    ASSERT_EQ(workspace_->boxes.size(), 1U) << tilt;
    const RaisedBox& box = workspace_->boxes[0];
    EXPECT_EQ(box.verdict, BoxVerdict::kConnector) << tilt;
    EXPECT_LT((box.rectangle.centre_m - planar(truth, scene.plates[0])).norm(), 0.006) << tilt;
    EXPECT_NEAR(box.rectangle.half_sides_m.x(), 0.06, 0.008) << tilt;
    EXPECT_NEAR(box.rectangle.half_sides_m.y(), 0.06, 0.008) << tilt;
    EXPECT_NEAR(box.height_m, scene.plate_z_m, 0.003) << tilt;
    EXPECT_NEAR(workspace_->base_m, scene.wall_z_m, 0.002) << tilt;
  }
}

TEST_F(BoxFits, ABarIsFoundWholeAndIsNoConnector) {
  SyntheticRing scene;
  scene.plates = {Vector2(0.0, 0.66)};
  scene.sides = {Vector2(0.30, 0.07)};
  find(scene, facing({0.0, 0.0, 2.3}, {0.2, 0.1, 0.5}));
  ASSERT_EQ(workspace_->boxes.size(), 1U);
  const RaisedBox& box = workspace_->boxes[0];
  EXPECT_EQ(box.verdict, BoxVerdict::kOther);
  EXPECT_NEAR(2.0 * box.rectangle.half_sides_m.maxCoeff(), 0.30, 0.03);
}

TEST_F(BoxFits, AFlatFaceHasNone) {
  SyntheticRing scene;
  scene.plates.clear();
  find(scene, facing({0.0, 0.0, 2.3}, {0.2, 0.1, 0.5}));
  EXPECT_TRUE(workspace_->boxes.empty());
  // And every place of it says so.
  const ReliefGrid& grid = workspace_->grid;
  const auto column = static_cast<int>(grid.column_of(0.66)), row = static_cast<int>(grid.column_of(0.0));
  EXPECT_LT(log_likelihood_of_box(*workspace_, fit_.model, column, row, 0.06, 0.07), -10.0);
}

}  // namespace
}  // namespace pharos::tof
