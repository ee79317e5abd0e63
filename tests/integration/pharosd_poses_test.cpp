// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "host/runtime/now.hpp"
#include "integration/pharosd_fixture.hpp"
#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

using Pharosd = PharosdTest;
LighthouseFromBody other_pose() { return {rotation_exp(Vector3(-0.1, 0.2, 0.0)), Vector3(-0.5, 0.1, 3.0)}; }

Vector6 error_of(const pose_t& pose, const LighthouseFromBody& truth) {
  const Quaternion q(pose.orientation_wxyz[0], pose.orientation_wxyz[1], pose.orientation_wxyz[2],
                     pose.orientation_wxyz[3]);
  return pose_difference(
      LighthouseFromBody{q.toRotationMatrix(), Vector3(pose.position_m[0], pose.position_m[1], pose.position_m[2])},
      truth);
}

TEST_F(Pharosd, LightOnTheLineBecomesPosesOnLcm) {
  start();
  ASSERT_TRUE(poses_come(30));
  std::int64_t last_utime = 0;
  std::int64_t sequence = daemon.poses().front().sequence;
  for (const pose_t& pose : daemon.poses()) {
    EXPECT_EQ(pose.status, "ok");
    EXPECT_EQ(pose.target, "dock");
    EXPECT_EQ(pose.source, "lighthouse/pharosd");
    const Vector6 error = error_of(pose, some_pose());
    EXPECT_LT(error.head<3>().norm(), 0.05 * kRadPerDeg);
    EXPECT_LT(error.tail<3>().norm(), 1e-3);
    EXPECT_GT(pose.utime, last_utime);
    EXPECT_EQ(pose.sequence, sequence++);
    last_utime = pose.utime;
  }
  EXPECT_LT(std::abs(utc_now_ns() / 1000 - last_utime), 200'000) << "utime is UTC of this computer";
}

TEST_F(Pharosd, TwoTargetsAreDistinguished) {
  PseudoTerminal second_line;
  daemon.plug_in(line);
  daemon.plug_in(second_line, "second");
  daemon.write_config("[[target]]\nname = 'free'\nport = '" + daemon.port("second") + "'\ntarget_file = 'dock.csv'\n");
  daemon.start();
  StationaryTarget here(some_pose());
  StationaryTarget there(other_pose());
  for (int i = 0; i < 400 && (daemon.valid_poses("dock") < 10 || daemon.valid_poses("free") < 10); ++i) {
    int cycles = 0;
    daemon.play(here, line, [&] { return cycles++ == 1; });
    cycles = 0;
    daemon.play(there, second_line, [&] { return cycles++ == 1; });
  }
  ASSERT_GE(daemon.valid_poses("dock"), 10u) << daemon.process().text();
  ASSERT_GE(daemon.valid_poses("free"), 10u);
  for (const pose_t& pose : daemon.poses()) {
    EXPECT_LT(error_of(pose, pose.target == "dock" ? some_pose() : other_pose()).tail<3>().norm(), 2e-3);
  }
}

TEST_F(Pharosd, WhatItHadToLeaveLyingIsNeverPublishedAsFresh) {
  start();
  ASSERT_TRUE(poses_come(60));
  // The daemon is stopped while ten cycles arrive, and continues a second later.
  daemon.process().signal(SIGSTOP);
  int cycles = 0;
  daemon.play(target, line, [&] { return cycles++ == 10; });
  const std::size_t before = daemon.poses().size();
  daemon.wait([] { return false; }, 1.0);
  const std::int64_t woken_us = utc_now_ns() / 1000;
  daemon.process().signal(SIGCONT);
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("cycles_stale") >= 10; })) << daemon.process().text();
  ASSERT_TRUE(daemon.play(target, line, [&] { return daemon.poses().size() >= before + 5; }));
  for (std::size_t i = before; i < daemon.poses().size(); ++i) {
    EXPECT_GT(daemon.poses()[i].utime, woken_us - 200'000) << "published after waking, but measured long before";
  }
}

TEST_F(Pharosd, GarbageOnTheLineCostsNoMoreThanItHits) {
  start();
  ASSERT_TRUE(poses_come(10));
  std::vector<std::uint8_t> garbage(5000);
  std::uint32_t state = 1;
  for (std::uint8_t& byte : garbage) byte = static_cast<std::uint8_t>((state = state * 1664525u + 1013904223u) >> 24);
  line.write(garbage);
  ASSERT_TRUE(poses_come(10));
  ASSERT_TRUE(daemon.wait([&] { return daemon.counter("link.garbage_bytes") > 4000; }));
}

TEST_F(Pharosd, CalibrationsAreKeptAcrossARestart) {
  start("", "state_directory = 'state'");
  line.write(target.ootx(0, 0xBEC08E38));
  line.write(target.ootx(0, 0xBEC08E38));
  EXPECT_TRUE(daemon.process().wait_for("calibration of station 0 (BEC08E38) in use")) << daemon.process().text();
  EXPECT_EQ(stop(), 0);
  ASSERT_TRUE(std::filesystem::exists(daemon.folder() / "state" / "stations.toml"));
  daemon.start();
  StationaryTarget again(some_pose());
  line.write(again.ootx(0, 0xBEC08E38));  // once is enough now
  EXPECT_TRUE(daemon.process().wait_for("calibration of station 0 (BEC08E38) in use")) << daemon.process().text();
}

}  // namespace
}  // namespace pharos::host
