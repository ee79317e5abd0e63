// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/map.hpp"

#include <gtest/gtest.h>

#include "host/vision/slam/mapping.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

// Links are consistent in both directions, and the tree has one root.
void expect_whole(const Map& map) {
  int roots = 0;
  for (const auto& [id, keyframe] : map.keyframes) {
    for (std::size_t k = 0; k < keyframe.points.size(); ++k) {
      if (keyframe.points[k] == kNone) continue;
      const auto& seen_by = map.points.at(keyframe.points[k]).seen_by;
      ASSERT_TRUE(seen_by.contains(id));
      EXPECT_EQ(seen_by.at(id), static_cast<int>(k));
    }
    for (const auto& [other, shared] : keyframe.neighbours) {
      ASSERT_TRUE(map.keyframes.contains(other));
      EXPECT_TRUE(map.keyframes.at(other).neighbours.contains(id));
    }
    roots += keyframe.parent == kNone ? 1 : 0;
    if (keyframe.parent != kNone) {
      EXPECT_TRUE(map.keyframes.at(keyframe.parent).children.contains(id));
    }
  }
  EXPECT_EQ(roots, 1);
  for (const auto& [id, point] : map.points) {
    ASSERT_FALSE(point.seen_by.empty());
    for (const auto& [keyframe, feature] : point.seen_by) {
      EXPECT_EQ(map.keyframes.at(keyframe).points[static_cast<std::size_t>(feature)], id);
    }
  }
}

class MapOfTurns : public ::testing::Test {
 protected:
  MapOfTurns() {
    points_ = random_points(random_, 60);
    for (std::size_t k = 0; k < points_.size(); ++k) descriptors_.push_back(descriptor_of(random_));
    for (int k = 0; k < 8; ++k) {
      Frame frame = frame_of(points_, descriptors_, turned_pose(0.03 * k), 0.2, random_);
      for (std::size_t p = 0; p < ids_.size(); ++p) frame.points[p] = ids_[p];
      const KeyframeId id = map_.add_keyframe(frame, {}).id;
      map_.update_neighbours(id);
      add_stereo_points(map_, id, kCamera);
      if (ids_.empty()) ids_ = map_.keyframes.at(id).points;
    }
  }

  std::mt19937_64 random_{1};
  std::vector<Vector3> points_;
  std::vector<Descriptor> descriptors_;
  std::vector<PointId> ids_;
  Map map_;
};

TEST_F(MapOfTurns, PointsAndKeyframesAgree) {
  EXPECT_EQ(map_.points.size(), points_.size());
  EXPECT_EQ(map_.points.at(ids_[0]).seen_by.size(), 8U);
  expect_whole(map_);
}

TEST_F(MapOfTurns, StaysWholeWhateverGoes) {
  for (int k = 0; k < 40; ++k) {
    switch (random_() % 4) {
      case 0:
        map_.fuse(ids_[random_() % ids_.size()], ids_[random_() % ids_.size()]);
        break;
      case 1:
        map_.remove_point(ids_[random_() % ids_.size()]);
        break;
      case 2:
        map_.remove_keyframe(static_cast<KeyframeId>(1 + random_() % 7));
        break;
      default: {
        const PointId point = ids_[random_() % ids_.size()];
        if (map_.points.contains(point)) map_.forget_observation(point, map_.points.at(point).seen_by.begin()->first);
      }
    }
    expect_whole(map_);
  }
}

TEST_F(MapOfTurns, ARemovedKeyframeIsStillKnownByItsPlace) {
  const CameraFromTarget before = map_.pose_of(4);
  map_.remove_keyframe(4);
  map_.remove_keyframe(map_.keyframes.at(5).parent);
  EXPECT_FALSE(map_.keyframes.contains(4));
  EXPECT_LT(pose_difference(map_.pose_of(4), before).norm(), 1e-9);
}

// No adjustment corrects what lies between a removed keyframe and the one that it is relative to.
TEST_F(MapOfTurns, ARemovedKeyframeIsAsUncertainAsItsPathWasLong) {
  for (auto& [id, keyframe] : map_.keyframes)
    keyframe.covariance = 1e-6 * static_cast<double>(id) * Matrix6::Identity();
  for (const KeyframeId id : {5, 4}) map_.remove_keyframe(id);
  EXPECT_LT((map_.covariance_of(5) - 5e-6 * Matrix6::Identity()).norm(), 1e-12);
  // A loop was closed: what is still in the map is better known, in any order.
  for (auto& [id, keyframe] : map_.keyframes) keyframe.covariance = 1e-7 * Matrix6::Identity();
  const Matrix6 after = map_.covariance_of(5);
  EXPECT_GT(after(0, 0), 1e-6);
  EXPECT_LT(after(0, 0), 5.2e-6);
}

// Data that must not grow in an endless run.
TEST_F(MapOfTurns, RemovedKeyframesWithoutReferencesAreErased) {
  for (const KeyframeId id : {3, 4, 5}) map_.remove_keyframe(id);
  map_.points.at(ids_[0]).patch = Patch{};
  map_.points.at(ids_[0]).patch->keyframe = 5;
  const CameraFromTarget of_patch = map_.pose_of(5), of_tracker = map_.pose_of(3);
  EXPECT_EQ(map_.removed(), 3U);
  map_.forget_removed(3);
  EXPECT_EQ(map_.pose_of(5).R, of_patch.R);
  EXPECT_EQ(map_.pose_of(3).R, of_tracker.R);
  EXPECT_LE(map_.removed(), 3U);
  map_.points.at(ids_[0]).patch.reset();
  map_.forget_removed(7);
  EXPECT_EQ(map_.removed(), 0U);
}

TEST_F(MapOfTurns, TheFirstKeyframeStays) {
  map_.remove_keyframe(0);
  EXPECT_TRUE(map_.keyframes.contains(0));
}

TEST_F(MapOfTurns, RedundantKeyframesGoAndTheLimitHolds) {
  EXPECT_GT(cull_keyframes(map_, 7, nullptr, 0), 0);
  expect_whole(map_);
  cull_keyframes(map_, 7, nullptr, 3);
  EXPECT_LE(map_.keyframes.size(), 3U);
  EXPECT_TRUE(map_.keyframes.contains(0));
  EXPECT_TRUE(map_.keyframes.contains(7));
  expect_whole(map_);
}

TEST_F(MapOfTurns, DoublePointsOfAKeyframeBecomeOne) {
  // The same landmarks observed again by a keyframe without their points.
  const Frame frame = frame_of(points_, descriptors_, turned_pose(0.1), 0.2, random_);
  const KeyframeId id = map_.add_keyframe(frame, {}).id;
  add_stereo_points(map_, id, kCamera);
  ASSERT_EQ(map_.points.size(), 2 * points_.size());
  const int fused = fuse_points(map_, ids_, id, kCamera, 3.0);
  EXPECT_GT(fused, 50);
  EXPECT_EQ(map_.points.size(), 2 * points_.size() - static_cast<std::size_t>(fused));
  map_.update_neighbours(id);
  expect_whole(map_);
}

// All of these were created eight keyframes ago.
TEST_F(MapOfTurns, PointsThatAreSeldomFoundOrSeenByTooFewGo) {
  for (const std::size_t k : {0U, 1U}) map_.points.at(ids_[k]).visible = 100;
  map_.points.at(ids_[0]).found = 24;
  map_.points.at(ids_[1]).found = 26;
  for (const KeyframeId id : {2, 3, 4, 5, 6, 7}) map_.forget_observation(ids_[2], id);
  for (const KeyframeId id : {2, 3, 4, 5, 6, 7}) map_.forget_observation(ids_[3], id);
  map_.points.at(ids_[3]).created_at = map_.newest() - 2;  // too recent for the limit on its number of observers
  std::vector<PointId> recent(ids_.begin(), ids_.begin() + 5);
  cull_points(map_, recent);
  EXPECT_EQ(map_.find_point(ids_[0]), nullptr);
  EXPECT_NE(map_.find_point(ids_[1]), nullptr);
  EXPECT_EQ(map_.find_point(ids_[2]), nullptr);
  EXPECT_NE(map_.find_point(ids_[3]), nullptr);
  EXPECT_NE(map_.find_point(ids_[4]), nullptr);
  EXPECT_EQ(recent, std::vector<PointId>{ids_[3]}) << "the others are no longer watched";
  expect_whole(map_);
}

}  // namespace
}  // namespace pharos::slam
