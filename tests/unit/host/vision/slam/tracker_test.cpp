// SPDX-License-Identifier: Apache-2.0
// The rules of 2.2: when a frame is tracked, when it becomes a keyframe, and when neither.
#include "host/vision/slam/tracker.hpp"

#include <gtest/gtest.h>

#include "host/vision/slam/mapping.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

constexpr std::size_t kPointsSeen = 150;

// One keyframe that observes all points; later frames observe the first of them.
class TrackerRules : public ::testing::Test {
 protected:
  TrackerRules() {
    for (std::size_t k = 0; k < kPointsSeen; ++k) descriptors_.push_back(descriptor_of(random_));
    const Frame frame = shown(0, kPointsSeen);
    const KeyframeId id = map_.add_keyframe(frame, {}).id;
    map_.update_neighbours(id);
    add_stereo_points(map_, id, kCamera);
    tracker_.became_keyframe(map_.keyframes.at(id));
  }
  Frame shown(std::int64_t number, std::size_t count) {
    const auto last = static_cast<std::ptrdiff_t>(count);
    Frame frame = frame_of({points_.begin(), points_.begin() + last},
                           {descriptors_.begin(), descriptors_.begin() + last}, pose_at(number), 0.2, random_);
    frame.number = number;
    frame.time_s = 0.05 * static_cast<double>(number);
    return frame;
  }
  Tracked track(std::int64_t number, std::size_t count, bool mapping_idle = true) {
    Frame frame = shown(number, count);
    frame.pose = {};
    return tracker_.track(frame, mapping_idle, {});
  }
  static CameraFromTarget pose_at(std::int64_t number) { return turned_pose(0.002 * static_cast<double>(number)); }

  std::mt19937_64 random_{6};
  std::vector<Vector3> points_ = random_points(random_, kPointsSeen);
  std::vector<Descriptor> descriptors_;
  Map map_;
  Tracker tracker_{kCamera, map_, nullptr};
};

TEST_F(TrackerRules, AFrameThatShowsWhatTheReferenceDoesIsNoKeyframe) {
  const Tracked tracked = track(1, kPointsSeen);
  ASSERT_EQ(tracked.state, TrackState::kTracking);
  EXPECT_LT(rotation_angle_between(tracked.pose.R, pose_at(1).R), 2e-3);
  EXPECT_GT(tracked.inliers, 140);
  EXPECT_FALSE(tracked.wants_keyframe);
}

// (4): fewer than 90 % of the reference's points.
TEST_F(TrackerRules, AFrameThatShowsLessIsAKeyframe) {
  EXPECT_TRUE(track(1, 120).wants_keyframe);
  EXPECT_TRUE(track(2, 80).wants_keyframe);
}

// (3): at least 50 points; with fewer than 30 the frame is lost, and has no pose.
TEST_F(TrackerRules, AFrameThatShowsHardlyAnythingIsNoKeyframeAndThenLost) {
  const Tracked few = track(1, 44);
  EXPECT_EQ(few.state, TrackState::kTracking);
  EXPECT_FALSE(few.wants_keyframe);
  EXPECT_EQ(track(2, 25).state, TrackState::kLost);
}

// (2): while mapping is busy, 20 frames after the last keyframe at the earliest.
TEST_F(TrackerRules, BusyMappingPutsKeyframesOff) {
  for (const std::int64_t number : {1, 10, 19}) EXPECT_FALSE(track(number, 100, false).wants_keyframe) << number;
  EXPECT_TRUE(track(20, 100, false).wants_keyframe);
}

// (1): none for 20 frames after relocalisation, which needs 50 points.
TEST_F(TrackerRules, FoundAgainItWaitsWithKeyframes) {
  EXPECT_EQ(track(1, 0).state, TrackState::kLost);
  EXPECT_EQ(track(2, 45).state, TrackState::kLost);
  const Tracked found = track(3, 100);
  EXPECT_EQ(found.state, TrackState::kTracking);
  EXPECT_TRUE(found.relocalised);
  EXPECT_FALSE(found.wants_keyframe);
  EXPECT_FALSE(track(22, 100).wants_keyframe);
  EXPECT_TRUE(track(23, 100).wants_keyframe);
}

// Two alike sides: lost while it turns slowly, the body is shown as if it had turned by half a turn within a pair.
TEST_F(TrackerRules, AKnownViewThatTheMotionRulesOutIsNoPlace) {
  for (std::int64_t number = 1; number < 6; ++number)
    ASSERT_EQ(track(number, kPointsSeen).state, TrackState::kTracking);
  ASSERT_EQ(track(6, 0).state, TrackState::kLost);
  const auto shown_at = [&](std::int64_t number, double turn_rad) {
    Frame frame = frame_of(points_, descriptors_, turned_pose(turn_rad), 0.2, random_);
    frame.number = number;
    frame.time_s = 0.05 * static_cast<double>(number);
    return frame;
  };
  Frame other_side = shown_at(7, 3.1);
  const Tracked refused = tracker_.track(other_side, true, {});
  EXPECT_EQ(refused.state, TrackState::kLost);
  EXPECT_TRUE(refused.ambiguous_place);
  EXPECT_FALSE(refused.relocalised);
  Frame same_side = shown_at(8, 0.016);
  const Tracked found = tracker_.track(same_side, true, {});
  EXPECT_EQ(found.state, TrackState::kTracking);
  EXPECT_TRUE(found.relocalised);
  EXPECT_FALSE(found.ambiguous_place);
}

TEST(MotionPrior, AllowsTwiceTheRateAndAHalfOfAViewingAngle) {
  const MotionPrior prior{turned_pose(0.0), Vector3::Zero(), 0.7, 0.0};  // 40 deg/s
  const auto turned = [](double degrees) { return turned_pose(degrees * 3.14159265 / 180.0); };
  EXPECT_TRUE(can_have_come_to(prior, turned(0.0), 0.0));
  EXPECT_TRUE(can_have_come_to(prior, turned(50.0), 0.3));
  EXPECT_FALSE(can_have_come_to(prior, turned(180.0), 0.3));
  EXPECT_FALSE(can_have_come_to(prior, turned(60.0), 0.05));
  CameraFromTarget aside = turned(0.0);
  aside.t.x() += 4.0;
  EXPECT_FALSE(can_have_come_to(prior, aside, 0.05));
}

}  // namespace
}  // namespace pharos::slam
