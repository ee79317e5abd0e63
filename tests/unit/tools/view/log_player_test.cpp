// SPDX-License-Identifier: Apache-2.0
#include "tools/view/log_player.hpp"

#include <gtest/gtest.h>

#include "host/support/input_error.hpp"
#include "some_messages.hpp"
#include "support/lcm_log.hpp"
#include "support/memory_file.hpp"

namespace pharos::tools {
namespace {

using test::MemoryFile;

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

// Ten poses a second for a minute, at x = the second; from 20 s to 30 s none.
std::string minute_of_poses() {
  std::string log;
  for (std::int64_t k = 0; k <= 600; ++k) {
    if (k > 200 && k < 300) continue;
    pose_t pose = test::some_pose(k);
    pose.utime = kStart_us + k * 100'000 - 5'000;
    pose.position_m[0] = static_cast<double>(k) * 0.1;
    log += test::logged(kStart_us + k * 100'000, "PHAROS_LIGHTHOUSE_POSE", test::encoded(pose));
  }
  return log;
}

class Replay : public ::testing::Test {
 protected:
  const std::string log_ = minute_of_poses();
  const MemoryFile file_{log_.data(), log_.size()};
  LogPlayer player_{file_.path()};

  const SourceRow& row() const { return player_.table().rows().begin()->second; }
  double shown_x() const { return row().pose->pose->t.x(); }
  void seek(double seconds) {
    ControlRequest request;
    request.seek_s = seconds;
    player_.control(request);
  }
};

TEST_F(Replay, PlaysInTheLogsOwnTime) {
  EXPECT_DOUBLE_EQ(player_.state().duration_s, 60.0);
  for (int k = 0; k < 150; ++k) player_.advance(1.0 / 30.0);
  EXPECT_NEAR(shown_x(), 5.0, 0.11);
  EXPECT_NEAR(row().age_at_arrival_s, 0.005, 1e-6) << "the age that it had";
  EXPECT_NEAR(static_cast<double>(row().arrivals_ns.size()), 10.0, 1.0) << "the rate that it had";
}

TEST_F(Replay, AnyPlaceIsShownAsIfItHadBeenPlayed) {
  for (const double place_s : {45.0, 3.0, 59.9, 0.0, 12.3}) {
    seek(place_s);
    EXPECT_NEAR(shown_x(), place_s, 0.11);
    EXPECT_NEAR(player_.state().position_s, place_s, 1e-9);
  }
}

TEST_F(Replay, WhereTheSourceWasLostItIsLost) {
  seek(25.0);
  EXPECT_TRUE(player_.table().rows().empty() || !row().current(player_.utc_ns()));
  seek(19.0);
  for (int k = 0; k < 360; ++k) player_.advance(1.0 / 30.0);
  ASSERT_EQ(player_.table().events().size(), 2u);
  EXPECT_NE(player_.table().events()[0].text.find("LOST"), std::string::npos);
  EXPECT_NE(player_.table().events()[1].text.find("FOUND"), std::string::npos);
}

TEST_F(Replay, PausesAndPlaysAtOtherSpeedsAndAgainFromTheEnd) {
  ControlRequest request;
  request.playing = false;
  player_.control(request);
  player_.advance(10.0);
  EXPECT_EQ(player_.state().position_s, 0.0);
  request.playing = true;
  request.speed = 4.0;
  player_.control(request);
  player_.advance(1.0);
  EXPECT_NEAR(player_.state().position_s, 4.0, 1e-6);
  player_.advance(100.0);
  EXPECT_FALSE(player_.state().playing) << "at the end";
  player_.control(request);
  EXPECT_EQ(player_.state().position_s, 0.0);
}

TEST(LogPlayer, ATimeThatCannotBeIsSkippedAndCounted) {
  const auto bytes = test::encoded(test::some_pose());
  const std::string log = test::logged(kStart_us, "P", bytes) + test::logged(kStart_us * 2, "P", bytes) +
                          test::logged(-5, "P", bytes) +
                          test::logged(kStart_us - 7'000'000, "P", bytes) +  // the clock was set back
                          test::logged(kStart_us + 2'000'000, "P", bytes);
  const MemoryFile file(log.data(), log.size());
  LogPlayer player(file.path());
  EXPECT_DOUBLE_EQ(player.state().duration_s, 2.0);
  EXPECT_EQ(player.state().skipped, 2);
  player.advance(5.0);
  EXPECT_EQ(player.table().received(), 3);
}

TEST(LogPlayer, AFileWithoutMessagesIsRefused) {
  const MemoryFile empty("", 0);
  EXPECT_THROW(LogPlayer{empty.path()}, host::InputError);
  const std::string text = "utime,source,target\n1,2,3\n";
  const MemoryFile table(text.data(), text.size());
  EXPECT_THROW(LogPlayer{table.path()}, host::InputError);
  EXPECT_THROW(LogPlayer{"/nonexistent/log"}, host::InputError);
  EXPECT_THROW(LogPlayer{"/dev/zero"}, host::InputError) << "a log that never ends has no last second";
}

}  // namespace
}  // namespace pharos::tools
