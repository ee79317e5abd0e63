// SPDX-License-Identifier: Apache-2.0
// The whole pipeline from images, on short sequences of a rotating satellite.
#include "host/vision/slam/slam_system.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "host/support/input_error.hpp"
#include "host/vision/slam/spin.hpp"
#include "tools/sim/stereo_tumbling/room_sequence.hpp"
#include "tools/sim/stereo_tumbling/street_sequence.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::slam {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr int kFrames = 25;

// 480x360, 1 deg a frame; rendered once for all tests.
struct Footage {
  sim::TumblingScenario scenario{.turn_deg = 40.0, .step_deg = 1.0, .width_px = 480, .height_px = 360, .povray = false};
  sim::TumblingSequence sequence{scenario, 5};
  std::vector<std::array<Bytes, 2>> pairs;

  const std::array<Bytes, 2>& pair(int frame) {
    while (static_cast<int>(pairs.size()) <= frame) {
      std::array<Bytes, 2> both;
      for (int side = 0; side < 2; ++side) {
        for (const std::uint16_t value : sequence.image(static_cast<int>(pairs.size()), side).pixels) {
          both[static_cast<std::size_t>(side)].push_back(static_cast<std::uint8_t>(value >> 8U));
        }
      }
      pairs.push_back(std::move(both));
    }
    return pairs[static_cast<std::size_t>(frame)];
  }
};

Footage& footage() {
  static Footage it;
  return it;
}

class SlamOfATurn : public ::testing::Test {
 protected:
  std::unique_ptr<SlamSystem> system(bool threads = false) {
    SlamSettings settings;
    settings.features = 800;
    settings.threads = threads;
    return make_slam(footage().sequence.rig(), "rig.toml", settings);
  }
  static ImageView<const std::uint8_t> view(const Bytes& image) { return {image.data(), 480, 360}; }
  static TrackedFrame push(SlamSystem& slam, int slot, int shown) {
    const auto& pair = footage().pair(shown);
    return slam.push(0.05 * slot, view(pair[0]), view(pair[1]));
  }
  static double error_deg(const TrackedFrame& frame, int shown) {
    return kDegrees * rotation_angle_between(frame.placed->pose.R, footage().sequence.truth(shown).R);
  }
};

// NEES per degree of freedom, mean over the frames except the first.
struct Consistency {
  double attitude = 0.0, position = 0.0;
};

template <class Truth>
Consistency consistency(const std::vector<TrackedFrame>& frames, Truth&& truth) {
  Consistency mean;
  const double fraction = 1.0 / (3.0 * static_cast<double>(frames.size() - 1));
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const TrackedPose& placed = *frames[k].placed;
    const Vector6 delta = pose_difference(truth(frames[k].number), placed.pose);
    const Vector3 turn = delta.head<3>(), move = delta.tail<3>();
    mean.attitude += fraction * turn.dot(placed.covariance.topLeftCorner<3, 3>().inverse() * turn);
    mean.position += fraction * move.dot(placed.covariance.bottomRightCorner<3, 3>().inverse() * move);
  }
  return mean;
}

// Errors of one short sequence are correlated from frame to frame: only a few independent numbers. Without drift in
// them the covariances of a quarter turn would be three to thirteen times too small.
void expect_consistent(const Consistency& mean) {
  EXPECT_GT(mean.attitude, 0.25);
  EXPECT_LT(mean.attitude, 2.0);
  EXPECT_GT(mean.position, 0.25);
  EXPECT_LT(mean.position, 2.0);
}

TEST_F(SlamOfATurn, FollowsTheAttitude) {
  const auto slam = system();
  std::vector<TrackedFrame> live;
  for (int k = 0; k < kFrames; ++k) {
    live.push_back(push(*slam, k, k));
    EXPECT_TRUE(live.back().placed) << k;
  }
  const auto truth = [](std::int64_t number) {
    const auto at = footage().sequence.truth(static_cast<int>(number));
    return Pose<frame::Camera, frame::Target>{at.R, at.t};
  };
  expect_consistent(consistency(live, truth));
  slam->finish();
  expect_consistent(consistency(slam->trajectory(), truth));
  const auto trajectory = slam->trajectory();
  ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(kFrames));
  for (int k = 0; k < kFrames; ++k) EXPECT_LT(error_deg(trajectory[static_cast<std::size_t>(k)], k), 0.5) << k;
  const SlamReport report = slam->report();
  EXPECT_EQ(report.scene, Scene::kTarget);
  EXPECT_EQ(report.frames, kFrames);
  EXPECT_EQ(report.tracked, kFrames);
  EXPECT_GE(report.keyframes, 2);
  EXPECT_EQ(slam->points().size(), static_cast<std::size_t>(report.points));
  const auto spin = slam->spin();
  ASSERT_TRUE(spin);
  EXPECT_NEAR(kDegrees * spin->rate(), 20.0, 0.3);
  const Vector3 axis = footage().sequence.pose(0).R.col(2);
  EXPECT_GT(spin->axis().dot(axis), std::cos(2.0 / kDegrees));
}

std::vector<Matrix3> attitudes_of(const std::vector<TrackedFrame>& trajectory) {
  std::vector<Matrix3> attitudes;
  for (const TrackedFrame& frame : trajectory) attitudes.push_back(frame.placed->pose.R);
  return attitudes;
}

// Also where optimised_trajectory() was called during one of the two runs.
TEST_F(SlamOfATurn, GivesTheSameBitsTwice) {
  const auto asked = system(), left_alone = system();
  for (int k = 0; k < 10; ++k) {
    push(*asked, k, k);
    push(*left_alone, k, k);
    if (k == 6) asked->optimised_trajectory();
  }
  EXPECT_EQ(attitudes_of(asked->trajectory()), attitudes_of(left_alone->trajectory()));
  const auto settled = attitudes_of(asked->optimised_trajectory());
  EXPECT_NE(settled, attitudes_of(asked->trajectory()));
  asked->finish();
  EXPECT_EQ(attitudes_of(asked->trajectory()), settled);
}

TEST_F(SlamOfATurn, ThreadsEndWithAMapAsGood) {
  const auto slam = system(true);
  for (int k = 0; k < 15; ++k) push(*slam, k, k);
  slam->finish();
  const auto trajectory = slam->trajectory();
  EXPECT_LT(error_deg(trajectory.back(), 14), 0.6);
  EXPECT_GE(slam->report().keyframes, 2);
}

TEST_F(SlamOfATurn, BlackAndSaturatedFramesHaveNoPoseAndItComesBack) {
  const auto slam = system();
  for (int k = 0; k < 8; ++k) push(*slam, k, k);
  const Bytes black(480 * 360, 0), white(480 * 360, 255);
  EXPECT_FALSE(slam->push(0.4, view(black), view(black)).placed);
  EXPECT_FALSE(slam->push(0.45, view(white), view(white)).placed);
  TrackedFrame back;
  for (int k = 8; k < 12 && !back.placed; ++k) back = push(*slam, k + 2, k);
  ASSERT_TRUE(back.placed);
  EXPECT_TRUE(back.relocalised);
  const SlamReport report = slam->report();
  EXPECT_EQ(report.dark, 1);
  EXPECT_EQ(report.saturated, 1);
  EXPECT_GE(report.lost, 2);
  EXPECT_EQ(report.relocalised, 1);
}

TEST_F(SlamOfATurn, IsTakenAsSteadyUnlessToldNotTo) {
  for (const bool may_be : {true, false}) {
    SlamSettings settings;
    settings.features = 800;
    settings.steady_rotation = may_be;
    const auto slam = make_slam(footage().sequence.rig(), "rig.toml", settings);
    for (int k = 0; k < 40; ++k) push(*slam, 4 * k, k);  // 5 Hz: a keyframe wherever one is wanted
    EXPECT_FALSE(slam->report().steady_rotation);
    slam->finish();
    ASSERT_GE(slam->report().keyframes, 10);
    EXPECT_EQ(slam->report().steady_rotation, may_be);
    const auto frames = slam->trajectory();
    const auto step = [&frames](std::size_t k) {
      return rotation_log(frames[k].placed->pose.R * frames[k - 1].placed->pose.R.transpose());
    };
    double uneven_rad = 0.0;
    for (std::size_t k = 2; k < frames.size(); ++k) uneven_rad = std::max(uneven_rad, (step(k) - step(1)).norm());
    EXPECT_EQ(uneven_rad < 1e-9, may_be);
    // What a fit to steady attitudes would state is nothing.
    const auto spin = slam->spin();
    ASSERT_TRUE(spin);
    EXPECT_GT(spin->sigma_rate_rad_s(), 1e-7);
    EXPECT_LT(std::abs(spin->rate() - 5.0 / kDegrees), 4.0 * spin->sigma_rate_rad_s());
    EXPECT_EQ((spin->rate_rad_s - 5.0 * step(1)).norm() < 1e-9, may_be);
    if (!may_be) continue;
    push(*slam, 4 * 40, 40);
    EXPECT_FALSE(slam->report().steady_rotation) << "until it is adjusted again";
  }
}

TEST_F(SlamOfATurn, ThereAndBackIsNotSteady) {
  const auto slam = system();
  for (int k = 0; k < 40; ++k) push(*slam, 4 * k, k <= 20 ? k : 40 - k);
  slam->finish();
  ASSERT_GE(slam->report().keyframes, 10);
  EXPECT_FALSE(slam->report().steady_rotation);
}

TEST_F(SlamOfATurn, AJumpOfTenDegreesIsFollowed) {
  const auto slam = system();
  for (int k = 0; k < 8; ++k) push(*slam, k, k);
  const TrackedFrame jumped = push(*slam, 8, 18);
  ASSERT_TRUE(jumped.placed);
  EXPECT_LT(error_deg(jumped, 18), 0.8);
}

TEST_F(SlamOfATurn, ARepeatedFrameStaysWhereItIs) {
  const auto slam = system();
  for (int k = 0; k < 6; ++k) push(*slam, k, k);
  const TrackedFrame again = push(*slam, 6, 5);
  ASSERT_TRUE(again.placed);
  EXPECT_LT(error_deg(again, 5), 0.4);
  EXPECT_EQ(slam->report().repeated, 1);
  EXPECT_TRUE(push(*slam, 7, 7).placed);
}

TEST_F(SlamOfATurn, ExchangedImagesAreNamed) {
  const auto slam = system();
  try {
    for (int k = 0; k < 8; ++k) {
      const auto& pair = footage().pair(k);
      slam->push(0.05 * k, view(pair[1]), view(pair[0]));
    }
    FAIL() << "nothing said";
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("exchanged"), std::string::npos) << error.what();
  }
}

// Matching names but wrong images: the right camera's are those of the frame before.
TEST_F(SlamOfATurn, RightImagesThatAreLateAreNamed) {
  const auto slam = system();
  try {
    for (int k = 1; k < kFrames; ++k) {
      slam->push(0.05 * k, view(footage().pair(k)[0]), view(footage().pair(k - 1)[1]));
    }
    FAIL() << "nothing said";
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("out of step"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("early by about 1 frame"), std::string::npos) << error.what();
  }
}

TEST_F(SlamOfATurn, ATargetThatWasAwayForLongIsFoundAgain) {
  const auto slam = system();
  for (int k = 0; k < 8; ++k) push(*slam, k, k);
  const Bytes empty(480 * 360, 3);
  for (int k = 8; k < 60; ++k) EXPECT_FALSE(slam->push(0.05 * k, view(empty), view(empty)).placed);
  const TrackedFrame back = push(*slam, 60, 6);
  ASSERT_TRUE(back.placed);
  EXPECT_TRUE(back.relocalised);
  EXPECT_LT(error_deg(back, 6), 0.5);
  EXPECT_EQ(slam->report().lost, 52);
}

TEST_F(SlamOfATurn, AnotherImageSizeIsNamed) {
  const auto slam = system();
  const Bytes small(320 * 240, 0);
  try {
    slam->push(0.0, {small.data(), 320, 240}, {small.data(), 320, 240});
    FAIL();
  } catch (const host::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("320 x 240"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("480 x 360"), std::string::npos);
  }
}

// Raw images of an unrectified, distorting rig: the walk's first metre.
class SlamOfARoom : public ::testing::Test {
 protected:
  using Pairs = std::vector<std::array<Bytes, 2>>;

  static const sim::RoomSequence& room() {
    static const sim::RoomSequence it({.path_m = 1.0, .width_px = 564, .height_px = 360}, 1);
    return it;
  }
  static const Pairs& pairs() {
    static const Pairs rendered = [] {
      Pairs out(static_cast<std::size_t>(room().frames()));
      for (int k = 0; k < room().frames(); ++k) {
        for (int side = 0; side < 2; ++side) {
          for (const std::uint16_t value : room().image(k, side).pixels) {
            out[static_cast<std::size_t>(k)][static_cast<std::size_t>(side)].push_back(
                static_cast<std::uint8_t>(value >> 8U));
          }
        }
      }
      return out;
    }();
    return rendered;
  }
  // The right camera's exposure time is this fraction of the left one's.
  static void expect_followed(const std::function<double(int)>& right_fraction) {
    const auto slam = make_slam(room().rig(), "rig.toml", {});
    for (int k = 0; k < room().frames(); ++k) {
      auto [left, right] = pairs()[static_cast<std::size_t>(k)];
      for (std::uint8_t& value : right)
        value = static_cast<std::uint8_t>(std::min(255L, std::lround(right_fraction(k) * value)));
      ASSERT_TRUE(slam->push(0.05 * k, {left.data(), 564, 360}, {right.data(), 564, 360}).placed) << k;
    }
    slam->finish();
    EXPECT_FALSE(slam->report().steady_rotation) << "a camera that moves";
    EXPECT_EQ(slam->report().scene, Scene::kStatic);
    for (const TrackedFrame& frame : slam->trajectory()) {
      const auto truth = room().truth(static_cast<int>(frame.number));
      const auto camera = frame.placed->pose.inverse();
      EXPECT_LT((camera.t - truth.t).norm(), 0.01) << frame.number;
      EXPECT_LT(kDegrees * rotation_angle_between(camera.R, truth.R), 0.2) << frame.number;
    }
  }
};

TEST_F(SlamOfARoom, FollowsTheCamera) {
  expect_followed([](int) { return 1.0; });
}

// Cameras with automatic exposure, which changes during the run.
TEST_F(SlamOfARoom, CamerasMayExposeDifferently) {
  expect_followed([](int k) { return k < 12 ? 0.5 : 1.4; });
}

// 1.2 m from pair to pair, and round a corner at 6 deg a pair: no prediction holds at the second pair and in the
// corner.
TEST(SlamOfAStreet, FollowsACar) {
  constexpr std::int32_t kWidth = 800, kHeight = 240;
  const sim::StreetSequence street(
      {.straight_m = 7.2, .turn_deg = 60.0, .width_px = kWidth, .height_px = kHeight, .rig_yaw_deg = 0.01}, 2);
  const auto slam = make_slam(street.rig(), "rig.toml", {});
  for (int k = 0; k < street.frames(); ++k) {
    std::array<Bytes, 2> pair;
    for (int side = 0; side < 2; ++side) {
      for (const std::uint16_t value : street.image(k, side).pixels) {
        pair[static_cast<std::size_t>(side)].push_back(static_cast<std::uint8_t>(value >> 8U));
      }
    }
    const TrackedFrame now = slam->push(0.1 * k, {pair[0].data(), kWidth, kHeight}, {pair[1].data(), kWidth, kHeight});
    EXPECT_TRUE(now.placed) << k;
    EXPECT_FALSE(now.relocalised) << k;
  }
  slam->finish();
  EXPECT_EQ(slam->report().scene, Scene::kStatic);
  for (const TrackedFrame& frame : slam->trajectory()) {
    if (!frame.placed) continue;
    const auto truth = street.truth(static_cast<int>(frame.number));
    const auto camera = frame.placed->pose.inverse();
    EXPECT_LT((camera.t - truth.t).norm(), 0.05 + 0.01 * truth.t.norm()) << frame.number;
    EXPECT_LT(kDegrees * rotation_angle_between(camera.R, truth.R), 0.5) << frame.number;
  }
}

}  // namespace
}  // namespace pharos::slam
