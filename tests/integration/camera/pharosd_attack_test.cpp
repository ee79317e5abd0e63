// SPDX-License-Identifier: Apache-2.0
// Hostile datagrams to a camera's port, or the end of its process, cost that camera some frames and do not affect
// others.
#include <sys/resource.h>

#include <csignal>

#include "integration/camera/attacked_daemon.hpp"

namespace pharos::host {
namespace {

TEST_F(AttackedDaemon, HostileDatagramsCostNoPoseOfTheLighthouseAndTheCameraGoesOn) {
  constexpr int kBurst = 50;
  constexpr int kBursts = 20;
  start_both();
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  HostileSender sender(1);
  for (const Attacker attacker : kAttackers) {
    for (int burst = 0; burst < kBursts; ++burst) {
      for (const std::uint16_t port : ports_of_others()) sender.send(attacker, port, kBurst);
      ASSERT_TRUE(lighthouse_poses_come(2)) << daemon.process().text();
    }
  }
  EXPECT_GT(sender.sent(), 2000);
  ASSERT_TRUE(camera_poses_come(3)) << daemon.process().text();
  expect_true_poses();
  EXPECT_EQ(lighthouse_poses_lost(), 0);
  ASSERT_TRUE(play_until([&] { return daemon.counter("device.datagrams_discarded", kCamera) > 1000; }));
  EXPECT_EQ(daemon.counter("device.camera_process_deaths", kCamera), 0) << daemon.process().text();
  EXPECT_EQ(daemon.process().wait_exit(0.0), -1) << "pharosd goes on";
}

TEST_F(AttackedDaemon, ACamerasProcessThatDiesIsToldCountedAndStartedAgain) {
  start_both();
  ASSERT_TRUE(both_measure()) << daemon.process().text();
  for (int death = 1; death <= 2; ++death) {
    const pid_t before = camera_process();
    ASSERT_TRUE(is_alive(before));
    ::kill(before, SIGKILL);
    ASSERT_TRUE(play_until([&] { return daemon.source(kCamera)->state == "gone"; }));
    EXPECT_EQ(daemon.source(kLighthouse)->state, "ok");
    ASSERT_TRUE(camera_poses_come(3)) << daemon.process().text();
    EXPECT_NE(camera_process(), before);
    ASSERT_TRUE(play_until([&] { return daemon.counter("device.camera_process_deaths", kCamera) == death; }));
  }
  expect_true_poses();
  EXPECT_EQ(lighthouse_poses_lost(), 0);
  EXPECT_TRUE(daemon.process().wait_for("the camera's process died: signal 9 (Killed); it is started again"));
  EXPECT_GE(daemon.counter("device.camera_opened", kCamera), 3) << "counters outlive the process";
}

TEST_F(AttackedDaemon, ACamerasProcessHasLittleMemoryOneSocketAndEndsWithPharosd) {
  start_both();
  ASSERT_TRUE(camera_poses_come(1)) << daemon.process().text();
  const pid_t process = camera_process();
  rlimit addresses{};
  ASSERT_EQ(::prlimit(process, RLIMIT_AS, nullptr, &addresses), 0);
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(addresses.rlim_cur, rlim_t{1} << 30);
#endif
  std::string far_ends;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/fd")) {
    std::error_code error;
    far_ends += std::filesystem::read_symlink(entry.path(), error).string() + ' ';
  }
  EXPECT_EQ(far_ends.find("/dev/pts"), std::string::npos) << "the lighthouse's line: " << far_ends;
  daemon.process().signal(SIGKILL);
  daemon.process().wait_exit();
  EXPECT_TRUE(daemon.wait([&] { return !is_alive(process); }));
}

TEST_F(AttackedDaemon, PharosdStopsInOrderAndGivesTheCameraBack) {
  start_both();
  ASSERT_TRUE(camera_poses_come(1)) << daemon.process().text();
  const pid_t process = camera_process();
  daemon.process().signal(SIGTERM);
  EXPECT_EQ(daemon.process().wait_exit(), 0);
  EXPECT_FALSE(is_alive(process));
  // The camera is released at once, without waiting for a heartbeat timeout.
  start(kByAddress);
  EXPECT_TRUE(poses_come(1)) << daemon.process().text();
}

}  // namespace
}  // namespace pharos::host
