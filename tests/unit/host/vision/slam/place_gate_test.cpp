// SPDX-License-Identifier: Apache-2.0
// What a place that was recognised must agree with.
#include "host/vision/slam/place_gate.hpp"

#include <gtest/gtest.h>

#include "host/vision/slam/loop_evidence.hpp"
#include "host/vision/slam/mapping.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

constexpr double kTurn_rad = 0.02;  // from keyframe to keyframe

// Keyframes that all observe the same points.
class PlaceGate : public ::testing::Test {
 protected:
  KeyframeId add(const std::vector<Vector3>& points, int k) {
    while (descriptors_.size() < points.size()) descriptors_.push_back(descriptor_of(random_));
    Frame frame = frame_of(points, descriptors_, turned_pose(kTurn_rad * k), 0.1, random_);
    frame.number = k;
    if (!map_.keyframes.empty()) frame.points = map_.keyframes.rbegin()->second.points;
    const KeyframeId id = map_.add_keyframe(frame, {}).id;
    add_stereo_points(map_, id, kCamera);
    map_.update_neighbours(id);
    return id;
  }
  // Every feature of a keyframe with its point.
  std::vector<std::pair<int, PointId>> seen(KeyframeId id) const {
    std::vector<std::pair<int, PointId>> out;
    const Keyframe& keyframe = map_.keyframes.at(id);
    for (std::size_t k = 0; k < keyframe.points.size(); ++k) {
      if (keyframe.points[k] != kNone) out.emplace_back(static_cast<int>(k), keyframe.points[k]);
    }
    return out;
  }

  std::mt19937_64 random_{3};
  std::vector<Descriptor> descriptors_;
  Map map_;
};

TEST_F(PlaceGate, TheOffsetIsAboutTheTargetsAxes) {
  const CameraFromTarget expected = turned_pose(0.7);
  const Vector3 turn(0.04, -0.07, 0.02), centre(0.3, 0.2, -0.1);
  const Pose<frame::Target, frame::Target> about_centre{rotation_exp(turn), centre - rotation_exp(turn) * centre};
  const Vector6 offset = place_offset(expected * about_centre, expected);
  EXPECT_LT((offset.head<3>() - turn).norm(), 1e-9);
  EXPECT_LT((offset.tail<3>() + turn.cross(centre)).norm(), 1e-6);
}

TEST_F(PlaceGate, AllowedDriftGrowsWithTheLinksAndWithTheStatedCovariance) {
  const std::vector<Vector3> points = random_points(random_, 150);
  for (int k = 0; k < 3; ++k) add(points, k);
  EXPECT_EQ(links_between(map_, 0, 0), 0);
  EXPECT_GE(links_between(map_, 2, 0), 1);
  const Matrix6 stated = 1e-4 * Matrix6::Identity();
  const Matrix6 before = drift_between(map_, 2, 0, kCamera);
  map_.keyframes.at(2).covariance = stated;
  EXPECT_LT((drift_between(map_, 2, 0, kCamera) - before - stated).norm(), 1e-12);
  // 0.1 px at 5 m and 640 px, about points within 0.8 m of their centre.
  EXPECT_NEAR(std::sqrt(before(0, 0) / links_between(map_, 2, 0)), 0.1 / 640.0 * 5.0 / 0.8, 2e-4);
}

TEST_F(PlaceGate, ADriftWithinTheCovarianceAgreesAndAPlaceBeyondItDoesNot) {
  const std::vector<Vector3> points = random_points(random_, 150);
  for (int k = 0; k < 4; ++k) add(points, k);
  const CameraFromTarget expected = map_.keyframes.at(3).pose;
  const Matrix6 drift = drift_between(map_, 3, 0, kCamera) + 1e-8 * Matrix6::Identity();
  EXPECT_FALSE(contradicts(place_offset(expected, expected), drift));
  for (const double turn : {0.5, 1.57, 3.1}) {
    const Pose<frame::Target, frame::Target> away{rotation_exp(Vector3(0.0, turn, 0.0)), Vector3::Zero()};
    EXPECT_TRUE(contradicts(place_offset(expected * away, expected), drift)) << turn;
  }
  EXPECT_TRUE(contradicts(Vector6::Zero(), Matrix6::Constant(std::nan(""))));
}

TEST_F(PlaceGate, APlaneIsOneSurfaceAndABodyIsNot) {
  std::vector<Vector3> wing = random_points(random_, 150);
  for (Vector3& point : wing) point.z() = 0.3 * point.x() - 0.1 * point.y();
  const KeyframeId flat = add(wing, 0);
  EXPECT_TRUE(on_one_plane(map_, seen(flat), map_.keyframes.at(flat), kCamera));
  map_ = Map();
  const KeyframeId body = add(random_points(random_, 150), 0);
  EXPECT_FALSE(on_one_plane(map_, seen(body), map_.keyframes.at(body), kCamera));
}

TEST_F(PlaceGate, NeighboursMustShowThePlaceToo) {
  const std::vector<Vector3> points = random_points(random_, 150);
  for (int k = 0; k < 4; ++k) add(points, k);
  const Keyframe& here = map_.keyframes.at(3);
  EXPECT_TRUE(neighbours_agree(map_, here, here.pose, 0, kCamera));
  const Pose<frame::Target, frame::Target> away{rotation_exp(Vector3(0.0, 1.0, 0.0)), Vector3::Zero()};
  EXPECT_FALSE(neighbours_agree(map_, here, here.pose * away, 0, kCamera));
}

}  // namespace
}  // namespace pharos::slam
