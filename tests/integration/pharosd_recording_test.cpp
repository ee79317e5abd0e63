// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "integration/daemon_under_test.hpp"

namespace pharos::host {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

LighthouseFromBody somewhere() { return {rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}; }

std::vector<fs::path> recordings_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

TEST(PharosdRecording, AReplayPublishesTheSamePosesWithTheSameTimes) {
  DaemonUnderTest daemon;
  PseudoTerminal line;
  daemon.plug_in(line);
  daemon.write_config("[recording]\ndirectory = 'raw'\n");
  daemon.start();
  StillTarget target(somewhere());
  ASSERT_TRUE(daemon.play(target, line, [&] { return daemon.valid_poses() >= 30; })) << daemon.process().text();
  daemon.process().signal(SIGTERM);
  ASSERT_EQ(daemon.process().wait_exit(), 0);
  daemon.wait([] { return false; }, 0.1);
  const std::vector<pose_t> live = daemon.poses();
  const std::vector<fs::path> files = recordings_in(daemon.folder() / "raw");
  ASSERT_EQ(files.size(), 1u);

  daemon.start({"--replay", files[0].string()});  // at real speed: half a second
  EXPECT_EQ(daemon.process().wait_exit(), 0) << "ends with the recording";
  daemon.wait([] { return false; }, 0.1);
  const std::size_t replayed = daemon.poses().size() - live.size();
  ASSERT_EQ(replayed, live.size());
  for (std::size_t i = 0; i < replayed; ++i) {
    const pose_t& again = daemon.poses()[live.size() + i];
    EXPECT_EQ(again.utime, live[i].utime);
    EXPECT_EQ(again.source, "lighthouse/pharosd/replay");
    EXPECT_EQ(std::vector<double>(again.position_m, again.position_m + 3),
              std::vector<double>(live[i].position_m, live[i].position_m + 3));
  }
}

TEST(PharosdRecording, OnAFullDiskPosesGoOnAndTheLossIsReported) {
  DaemonUnderTest daemon;
  PseudoTerminal line;
  daemon.plug_in(line);
  daemon.write_config("[recording]\ndirectory = 'raw'\n");
  constexpr unsigned long kFileSizeLimit = 8192;  // a few dozen cycles: writing then fails as on a full disk
  daemon.start({}, kFileSizeLimit);
  StillTarget target(somewhere());
  ASSERT_TRUE(daemon.play(target, line, [&] { return daemon.counter("recording.bytes_lost") > 0; }))
      << daemon.process().text();
  EXPECT_THAT(daemon.status()->message, HasSubstr("not being recorded"));
  EXPECT_NE(daemon.status()->state, "ok");
  EXPECT_TRUE(daemon.process().wait_for("not being recorded")) << daemon.process().text();
  const std::size_t before = daemon.valid_poses();
  EXPECT_TRUE(daemon.play(target, line, [&] { return daemon.valid_poses() >= before + 30; }))
      << daemon.process().text();
}

TEST(PharosdRecording, NothingIsRecordedUnlessAskedFor) {
  DaemonUnderTest daemon;
  PseudoTerminal line;
  daemon.plug_in(line);
  daemon.write_config();
  daemon.start();
  StillTarget target(somewhere());
  ASSERT_TRUE(daemon.play(target, line, [&] { return daemon.valid_poses() >= 5; })) << daemon.process().text();
  EXPECT_EQ(daemon.counter("recording.bytes"), -1);
}

}  // namespace
}  // namespace pharos::host
