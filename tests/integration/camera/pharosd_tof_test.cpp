// SPDX-License-Identifier: Apache-2.0
// The program pharosd with the simulated Helios and the simulated satellite.
#include <gmock/gmock.h>

#include <csignal>

#include "integration/camera/pharosd_tof_fixture.hpp"
#include "tools/sim/tof/tof_writer.hpp"

namespace pharos::host {
namespace {

const ::testing::Environment* const kNetwork = ::testing::AddGlobalTestEnvironment(new NetworkNamespace);

class StationaryTofTest : public PharosdTofTest {
 protected:
  StationaryTofTest() {
    render("tof_still.toml", 3);
    play.frame_rate_hz = 5.0;
  }
};

TEST_F(StationaryTofTest, MeasuresWhatTheCameraSees) {
  serve();
  start(kByAddress);
  ASSERT_TRUE(poses_come(5)) << daemon.process().text();
  expect_true_poses();
  const pose_t& pose = daemon.poses().back();
  EXPECT_EQ(pose.source, "tof/helios");
  EXPECT_EQ(pose.station_or_camera, "helios");
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("frames_ok", "client") > 0; }, kTimeout_s));
  EXPECT_GT(daemon.counter("estimator_p50_us", "client"), 0);
  EXPECT_GT(daemon.counter("estimator.edges_p50_us", "client"), 0);
  EXPECT_GT(daemon.counter("estimator.connector_p50_us", "client"), 0);
  EXPECT_EQ(daemon.source("client")->state, "ok");
}

TEST_F(StationaryTofTest, GoesOnWhenTheCameraComesBack) {
  serve();
  start(kByAddress);
  ASSERT_TRUE(poses_come(2)) << daemon.process().text();
  camera.reset();
  ASSERT_TRUE(
      daemon.wait([&] { return daemon.source("client") && daemon.source("client")->state != "ok"; }, kTimeout_s));
  EXPECT_FALSE(daemon.source("client")->message.empty());
  serve();
  ASSERT_TRUE(poses_come(2)) << daemon.process().text();
  expect_true_poses();
}

TEST_F(StationaryTofTest, TellsWhenItsCameraNoLongerFollowsPtp) {
  play.ptp = true;
  play.ptp_masterless = {{6.0, 1e6}};
  serve();
  start(kByAddress);
  const auto told = [&](const std::string& words) {
    return daemon.wait(
        [&] { return daemon.source("client") && daemon.source("client")->identity.find(words) != std::string::npos; },
        kTimeout_s);
  };
  ASSERT_TRUE(told(", PTP slave")) << daemon.process().text();
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("clock.by_ptp", "client") == 1; }, kTimeout_s));
  EXPECT_EQ(daemon.source("client")->clock_sigma_us, 100.0);
  ASSERT_TRUE(told(", PTP listening")) << daemon.process().text();
  EXPECT_EQ(daemon.counter("clock.ptp_state", "client"), 4);
  EXPECT_EQ(daemon.counter("device.ptp_losses", "client"), 1);
  ASSERT_TRUE(poses_come(2)) << daemon.process().text();
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("clock.by_ptp", "client") == 0; }, kTimeout_s));
  EXPECT_GT(daemon.source("client")->clock_sigma_us, 100.0);
  EXPECT_THAT(daemon.process().text(), ::testing::HasSubstr("PTP listening: times are estimated from arrivals"));
  expect_true_poses();
}

TEST_F(StationaryTofTest, PublishesNoWrongPoseWhilePacketsAreLost) {
  play.loss = 0.001;
  serve();
  start(kByAddress);
  ASSERT_TRUE(daemon.wait(
      [&] { return daemon.valid_poses("client") >= 5 && daemon.counter("device.frames_incomplete", "client") >= 2; },
      kTimeout_s))
      << daemon.process().text();
  expect_true_poses();
}

TEST_F(StationaryTofTest, StopsCleanlyWhileItLooksForACamera) {
  start("address = '127.0.0.1'\n");
  ASSERT_TRUE(
      daemon.wait([&] { return daemon.source("client") && daemon.source("client")->state == "gone"; }, kTimeout_s));
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait_exit(), 0);
}

// frames = "DIRECTORY": recorded frames, at their own rate; then the source reports its end.
TEST_F(PharosdTofTest, MeasuresRecordedFrames) {
  constexpr std::size_t kFrames = 3;
  const std::filesystem::path folder = daemon.folder() / "recorded";
  sim::TofScenario scenario = sim::read_tof_scenario(std::string(PHAROS_SCENARIOS) + "/tof_still.toml", 1);
  scenario.poses.resize(kFrames);
  sim::TofSimulator simulator(scenario, 1);
  sim::write_tof_frames(simulator, folder, [] {});
  std::filesystem::copy_file(folder / "camera.toml", daemon.folder() / "helios.toml");
  sequence.frames.resize(1);
  sequence.frames[0].T_camera_target = simulator.truth(0).T_camera_target;
  start("frames = 'recorded'\nframe_rate_hz = 5\n");
  ASSERT_TRUE(poses_come(kFrames)) << daemon.process().text();
  expect_true_poses();
  ASSERT_TRUE(
      daemon.wait([&] { return daemon.source("client") && daemon.source("client")->state == "stale"; }, kTimeout_s));
  EXPECT_NE(daemon.source("client")->message.find("end"), std::string::npos);
  EXPECT_EQ(daemon.counter("frames_ok", "client"), kFrames);
}

TEST_F(StationaryTofTest, ARecordedCameraIsReplayedWithTheSamePoses) {
  serve();
  start(kByAddress, "[recording]\ndirectory = 'raw'\ncameras = true\n");
  ASSERT_TRUE(poses_come(10)) << daemon.process().text();
  EXPECT_GT(daemon.counter("recording.frames", "client"), 0);
  EXPECT_EQ(daemon.counter("recording.frames_lost", "client"), 0);
  daemon.process().signal(SIGTERM);
  ASSERT_EQ(daemon.process().wait_exit(), 0);
  daemon.wait([] { return false; }, 0.1);
  const std::vector<pose_t> live = daemon.poses();

  daemon.start({"--replay", (daemon.folder() / "raw").string()});
  EXPECT_EQ(daemon.process().wait_exit(), 0) << "ends with the recording";
  daemon.wait([] { return false; }, 0.1);
  ASSERT_GE(daemon.poses().size(), 2 * live.size()) << "the last frames were recorded and, stopped, not measured";
  for (std::size_t k = 0; k < live.size(); ++k) {
    const pose_t& again = daemon.poses()[live.size() + k];
    EXPECT_EQ(again.utime, live[k].utime);
    EXPECT_EQ(again.status, live[k].status);
    EXPECT_EQ(std::vector<double>(again.position_m, again.position_m + 3),
              std::vector<double>(live[k].position_m, live[k].position_m + 3));
  }
}

}  // namespace
}  // namespace pharos::host
