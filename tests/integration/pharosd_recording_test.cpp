// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "integration/pharosd_fixture.hpp"

namespace pharos::host {
namespace {

using PharosdRecording = PharosdTest;
namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::vector<fs::path> recordings_in(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

TEST_F(PharosdRecording, AReplayPublishesTheSamePosesWithTheSameTimes) {
  start("[recording]\ndirectory = 'raw'\n");
  ASSERT_TRUE(poses_come(30));
  ASSERT_EQ(stop(), 0);
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

TEST_F(PharosdRecording, OnAFullDiskPosesGoOnAndTheLossIsReported) {
  constexpr unsigned long kFileSizeLimit = 8192;  // a few dozen cycles: writing then fails as on a full disk
  start("[recording]\ndirectory = 'raw'\n", "", kFileSizeLimit);
  ASSERT_TRUE(daemon.play(target, line, [&] { return daemon.counter("recording.bytes_lost") > 0; }))
      << daemon.process().text();
  EXPECT_THAT(daemon.status()->message, HasSubstr("not being recorded"));
  EXPECT_NE(daemon.status()->state, "ok");
  EXPECT_TRUE(daemon.process().wait_for("not being recorded")) << daemon.process().text();
  EXPECT_TRUE(poses_come(30));
}

TEST_F(PharosdRecording, NothingIsRecordedUnlessAskedFor) {
  start();
  ASSERT_TRUE(poses_come(5));
  EXPECT_EQ(daemon.counter("recording.bytes"), -1);
}

}  // namespace
}  // namespace pharos::host
