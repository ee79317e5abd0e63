// SPDX-License-Identifier: Apache-2.0
// The program pharosd with recorded pairs and with two simulated grey cameras: ring2 and slam.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <optional>

#include "host/cameras/rig_file.hpp"
#include "host/runtime/now.hpp"
#include "integration/daemon_under_test.hpp"
#include "support/painted_ring_pair.hpp"
#include "tools/sim/camera/fake_helios.hpp"
#include "tools/sim/camera/make_sequence.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr double kStereoTimeout_s = 120.0;  // allows for other load
constexpr double kDeg = 0.017453292519943295;

Matrix3 rotation_of(const pose_t& pose) {
  return Quaternion(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                    pose.orientation_wxyz[3])
      .toRotationMatrix();
}

class PharosdStereoTest : public ::testing::Test {
 protected:
  /// `dimmer`: factor by which the light is below the range of eight bits.
  void write_pairs(int count, int bits = 8, std::uint16_t dimmer = 1) {
    fs::create_directories(pairs);
    truths.clear();
    for (int k = 0; k < count; ++k) {
      truths.push_back(test::ring_at({0.02 * k, -0.01, 2.6}, 5.0 * k * kDeg, (10.0 - 8.0 * k) * kDeg));
      for (std::size_t side = 0; side < 2; ++side) {
        GreyImage image = painted.image(truths.back(), side, side);
        for (std::uint16_t& pixel : image.pixels) pixel = static_cast<std::uint16_t>(pixel / dimmer);
        const std::string name = "000" + std::to_string(k) + (side == 0 ? "_left.png" : "_right.png");
        write_grey_png((pairs / name).string(), image.view(), bits);
      }
    }
    std::ofstream(daemon.folder() / "rig.toml") << rig_text(painted.file());
  }
  ChildProcess& start(const std::string& stereo, const std::vector<std::string>& arguments = {}) {
    std::ofstream(daemon.folder() / "pharosd.toml")
        << "[lcm]\nurl = '" << daemon.url() << "'\n[publish]\nstatus_rate_hz = 10\nmax_age_s = 10.0\n"
        << "[[stereo]]\nname = 'bow'\ntarget = 'client'\nrig_file = 'rig.toml'\n"
        << stereo;
    return daemon.start(arguments);
  }
  void expect_ring(const pose_t& pose, const sim::RingAndNozzle& truth) const {
    EXPECT_EQ(pose.status, "ok");
    EXPECT_LT(rotation_of(pose).col(2).cross(truth.normal).norm(), 0.1 * kDeg);
    EXPECT_LT((Vector3(pose.position_m) - truth.ring_centre_m).norm(), 0.003);
  }

  DaemonUnderTest daemon;
  fs::path pairs = daemon.folder() / "pairs";
  test::PaintedRig painted;
  std::vector<sim::RingAndNozzle> truths;
};

TEST_F(PharosdStereoTest, ReportsTheRingsPoseOfRecordedPairs) {
  write_pairs(3);
  ChildProcess& pharosd = start("systems = ['ring2']\nframes = 'pairs'\nframe_rate_hz = 0.5\n");
  ASSERT_TRUE(daemon.wait([&] { return daemon.valid_poses("client") >= 3; }, kStereoTimeout_s)) << pharosd.text();
  for (std::size_t k = 0; k < truths.size(); ++k) expect_ring(daemon.poses()[k], truths[k]);
  EXPECT_NEAR(static_cast<double>(daemon.poses()[2].utime - daemon.poses()[0].utime), 4e6, 2.0) << "0.5 pairs/s";
  EXPECT_EQ(daemon.poses()[0].source, "ring2/bow");
  EXPECT_EQ(daemon.poses()[0].flags, "no_connector") << "the turn about the axis is not told";
  EXPECT_EQ(pharosd.wait_exit(kStereoTimeout_s), 0) << "at the recording's end";
  EXPECT_TRUE(daemon.wait([&] { return daemon.counter("pairs_ok", "client") == 3; })) << "told at the end";
}

TEST_F(PharosdStereoTest, FollowsATumblingTargetInRecordedPairs) {
  const sim::TumblingScenario scenario{
      .turn_deg = 20.0, .step_deg = 1.0, .width_px = 480, .height_px = 360, .povray = false};
  sim::write_tumbling(scenario, 5, pairs.string(), [] {});
  fs::copy_file(pairs / "rig.toml", daemon.folder() / "rig.toml");
  const sim::TumblingSequence sequence(scenario, 5);
  ChildProcess& pharosd = start("systems = ['slam']\nframes = 'pairs'\n[stereo.slam]\nfeatures = 800\n", {"--fast"});
  EXPECT_EQ(pharosd.wait_exit(kStereoTimeout_s), 0) << pharosd.text();
  const auto frames = static_cast<std::size_t>(sequence.frames());
  ASSERT_TRUE(daemon.wait([&] { return daemon.poses().size() >= frames; }, kStereoTimeout_s));
  for (std::size_t k = 0; k < frames; ++k) {
    const pose_t& pose = daemon.poses()[k];
    ASSERT_EQ(pose.status, "ok") << k;
    EXPECT_EQ(pose.source, "slam/bow");
    EXPECT_EQ(pose.parent_frame, "camera");
    EXPECT_EQ(pose.flags, k == 0 ? "map_start" : "");
    EXPECT_NEAR(static_cast<double>(pose.utime - daemon.poses()[0].utime), 5e4 * static_cast<double>(k), 2.0);
    const auto truth = sequence.truth(static_cast<int>(k));
    EXPECT_LT(rotation_angle_between(rotation_of(pose), truth.R), 0.5 * kDeg) << k;
    EXPECT_LT((Vector3(pose.position_m) - truth.t).norm(), 0.03) << k;
    if (k == 0) continue;
    EXPECT_GT(pose.sigma_rot_rad, 0.0);
    EXPECT_GT(pose.residual_rms_rad, 0.0);
    EXPECT_GT(pose.observations, 30);
  }
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("pairs_ok", "client") == static_cast<std::int64_t>(frames); }));
  EXPECT_GE(daemon.counter("slam.keyframes", "client"), 1);
  ASSERT_EQ(daemon.spins().size(), 2U) << "once a second";
  EXPECT_EQ(daemon.spins()[0].status, "refused_too_few");
  const spin_t& spin = daemon.spins()[1];
  EXPECT_EQ(spin.valid, 1);
  EXPECT_EQ(spin.source, "slam/bow");
  EXPECT_EQ(spin.utime, daemon.poses().back().utime);
  EXPECT_NEAR(Vector3(spin.rate_rad_s).norm(), 20.0 * kDeg, 0.5 * kDeg) << "1 deg a pair, 20 pairs a second";
  EXPECT_GT(Vector3(spin.axis).dot(sequence.pose(0).R.col(2)), std::cos(2.0 * kDeg));
}

// Three pairs without light and one that cannot be read: reported, without a pose, and then tracked again.
TEST_F(PharosdStereoTest, ALostTargetHasNoPoseUntilItIsFoundAgain) {
  const sim::TumblingScenario scenario{
      .turn_deg = 13.0, .step_deg = 1.0, .width_px = 480, .height_px = 360, .povray = false};
  sim::write_tumbling(scenario, 5, pairs.string(), [] {});
  fs::copy_file(pairs / "rig.toml", daemon.folder() / "rig.toml");
  const std::vector<std::uint16_t> black(std::size_t{480} * 360, 0);
  for (const char* name : {"000007.png", "000008.png", "000009.png"}) {
    for (const char* side : {"left", "right"})
      write_grey_png((pairs / side / name).string(), {black.data(), 480, 360}, 8);
  }
  std::ofstream(pairs / "right" / "000012.png") << "no image";
  const sim::TumblingSequence sequence(scenario, 5);
  ChildProcess& pharosd = start("systems = ['slam']\nframes = 'pairs'\n[stereo.slam]\nfeatures = 800\n", {"--fast"});
  EXPECT_EQ(pharosd.wait_exit(kStereoTimeout_s), 0) << pharosd.text();
  ASSERT_TRUE(daemon.wait([&] { return daemon.poses().size() >= 13; }, kStereoTimeout_s));
  for (std::size_t k = 0; k < 13; ++k) {
    const pose_t& pose = daemon.poses()[k];
    if (k >= 7 && k <= 9) {
      EXPECT_EQ(pose.valid, 0) << k;
      EXPECT_EQ(pose.status, "refused_lost") << k;
      continue;
    }
    EXPECT_EQ(pose.valid, 1) << k;
    EXPECT_EQ(pose.flags, k == 0 ? "map_start" : k == 10 ? "relocalised" : "") << k;
    const auto truth = sequence.truth(static_cast<int>(k < 12 ? k : 13));
    EXPECT_LT(rotation_angle_between(rotation_of(pose), truth.R), 0.5 * kDeg) << k;
  }
  EXPECT_TRUE(daemon.wait([&] { return daemon.counter("refused.lost", "client") == 3; }));
  EXPECT_EQ(daemon.counter("device.pairs_unreadable", "client"), 1);
}

TEST_F(PharosdStereoTest, WhatIsNoGoodIsSaidBeforeAnythingStarts) {
  write_pairs(1);
  sim::StereoRig other = painted.rig;
  for (sim::StereoCamera& camera : other) camera.width_px = 1280;
  std::ofstream(daemon.folder() / "other.toml") << rig_text(test::PaintedRig{other}.file());
  std::ofstream(daemon.folder() / "short.words") << "no words";
  const std::string words = (daemon.folder() / "short.words").string();
  for (const auto& [keys, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"rig_file = 'other.toml'\nsystems = ['ring2']\nframes = 'pairs'\n",
            "640 x 512 pixels, the rig's camera 1280"},
           {"rig_file = 'rig.toml'\nsystems = ['slam']\nframes = 'pairs'\n[stereo.slam]\nvocabulary = 'short.words'\n",
            words},
           {"rig_file = 'rig.toml'\nsystems = ['slam']\nframes = 'none'\n", "none"}}) {
    std::ofstream(daemon.folder() / "pharosd.toml") << "[[stereo]]\nname = 'bow'\ntarget = 'client'\n" << keys;
    ChildProcess check({DaemonUnderTest::program(), "--check", (daemon.folder() / "pharosd.toml").string()});
    EXPECT_EQ(check.wait_exit(kStereoTimeout_s), 2) << keys;
    EXPECT_THAT(check.text(), HasSubstr(complaint));
  }
}

/// Two grey cameras with different clock offsets and jitter.
class TwoCamerasTest : public PharosdStereoTest {
 protected:
  TwoCamerasTest() {
    for (std::size_t side = 0; side < 2; ++side) {
      sim::CameraPlay& play = plays[side];
      play.grey = true;
      play.frame_rate_hz = 4.0;
      play.address = side == 0 ? "127.0.0.1" : "127.0.0.2";
      play.serial = side == 0 ? "L1" : "R1";
      play.clock_start_s = side == 0 ? 1000.0 : 77.0;
      play.clock_ppm = side == 0 ? 20.0 : -30.0;
      play.clock_jitter_s = 0.0005;
    }
  }
  void serve_pair(int bits, std::uint16_t dimmer = 1) {
    write_pairs(1, bits, dimmer);
    for (std::size_t side = 0; side < 2; ++side) {
      sequences[side] = sim::sequence_of_pairs(pairs.string(), side, 1);
      serve(side);
    }
  }
  /// With a window for a busy machine: late arrivals get late times.
  void start_cameras(const std::string& more, const std::string& system = "ring2") {
    start("systems = ['" + system + "']\npacket_size = 9000\npairing_window_ms = 100\n" + more +
          "[stereo.left]\naddress = '127.0.0.1'\n[stereo.right]\naddress = '127.0.0.2'\n");
  }
  void serve(std::size_t side) { cameras[side].emplace(sequences[side], plays[side], nullptr, monotonic_now_ns()); }
  bool poses_come(std::size_t count) {
    const std::size_t wanted = daemon.valid_poses("client") + count;
    return daemon.wait([&] { return daemon.valid_poses("client") >= wanted; }, kStereoTimeout_s);
  }

  std::array<sim::FrameSequence, 2> sequences;
  std::array<sim::CameraPlay, 2> plays;
  std::array<std::optional<sim::FakeHelios>, 2> cameras;
};

TEST_F(TwoCamerasTest, PairsFramesOfTwoClocksAndGoesOnWhenALostCameraComesBack) {
  serve_pair(8);
  start_cameras("");
  ASSERT_TRUE(poses_come(3)) << daemon.process().text();
  for (const pose_t& pose : daemon.poses()) {
    if (pose.valid != 0) expect_ring(pose, truths[0]);
  }
  EXPECT_NEAR(static_cast<double>(daemon.poses().back().utime), static_cast<double>(utc_now_ns()) * 1e-3, 3e7);
  cameras[1].reset();
  ASSERT_TRUE(daemon.wait(
      [&] {
        const auto& source = *daemon.source("client");
        return source.state != "ok" && source.message.find("right: ") != std::string::npos &&
               daemon.counter("left.frames_without_partner", "client") > 2;
      },
      kStereoTimeout_s))
      << daemon.source("client")->message;
  serve(1);
  ASSERT_TRUE(poses_come(3)) << daemon.process().text();
  expect_ring(daemon.poses().back(), truths[0]);
  EXPECT_THAT(daemon.source("client")->identity, HasSubstr("Mono8"));
  EXPECT_GE(daemon.counter("right.camera_opened", "client"), 2);
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait_exit(), 0);
}

// The same two cameras with a stationary satellite: the rotation since the first pair is zero.
TEST_F(TwoCamerasTest, FollowASatelliteWithoutAModel) {
  const sim::TumblingScenario scenario{
      .turn_deg = 0.0, .step_deg = 1.0, .width_px = 480, .height_px = 360, .povray = false};
  sim::write_tumbling(scenario, 5, pairs.string(), [] {});
  fs::copy_file(pairs / "rig.toml", daemon.folder() / "rig.toml");
  for (std::size_t side = 0; side < 2; ++side) {
    sequences[side] = sim::sequence_of_pairs(pairs.string(), side, 1);
    serve(side);
  }
  start_cameras("[stereo.slam]\nfeatures = 800\n", "slam");
  ASSERT_TRUE(poses_come(5)) << daemon.process().text();
  for (const pose_t& pose : daemon.poses()) {
    if (pose.valid == 0) continue;
    EXPECT_EQ(pose.source, "slam/bow");
    EXPECT_LT(rotation_angle_between(rotation_of(pose), Matrix3::Identity()), 0.1 * kDeg);
    EXPECT_LT(Vector3(pose.position_m).norm(), 0.01);
  }
  EXPECT_GT(daemon.poses().back().observations, 100);
  EXPECT_NEAR(static_cast<double>(daemon.poses().back().utime), static_cast<double>(utc_now_ns()) * 1e-3, 3e7);
}

TEST_F(TwoCamerasTest, SixteenBitsSeeARingInAnEighthOfTheLight) {
  serve_pair(16, 8);
  start_cameras("pixel_format = 'Mono16'\n");
  ASSERT_TRUE(poses_come(2)) << daemon.process().text();
  for (const pose_t& pose : daemon.poses()) {
    if (pose.valid != 0) expect_ring(pose, truths[0]);
  }
  ASSERT_TRUE(daemon.wait([&] { return daemon.source("client") != nullptr; }, kStereoTimeout_s));
  EXPECT_THAT(daemon.source("client")->identity, HasSubstr("Mono16"));
}

}  // namespace
}  // namespace pharos::host
