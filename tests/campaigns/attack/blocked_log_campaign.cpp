// SPDX-License-Identifier: Apache-2.0
// A log that nobody reads, at the level of a line for every message; SIGTERM while it is blocked.

#include <csignal>

#include "campaigns/attack/attacked_lighthouse.hpp"
#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

using AttackedLog = AttackedLighthouse;

TEST_F(AttackedLog, NobodyReadsIt) {
  const auto stops = static_cast<int>(campaign_size("PHAROS_ATTACK_STOPS", 5));
  constexpr double kBlocked_s = 5.0;
  double longest_s = 0.0;
  std::int64_t sent = 0, lost = 0;
  std::string peak;
  for (int stop = 0; stop < stops; ++stop) {
    if (stop == 0) {
      start("", "log.level = 'trace'\n");
    } else {
      daemon.start();
    }
    ASSERT_TRUE(measures()) << daemon.process().text();
    ASSERT_TRUE(daemon.process().fill_standard_error());
    play_for(kBlocked_s);
    sent += sweeps_sent();
    lost += lost_poses();
    peak = memory();
    const std::int64_t began_ns = monotonic_now_ns();
    daemon.process().signal(SIGTERM);
    EXPECT_EQ(daemon.process().wait_exit_unread(10.0), 0);
    longest_s = std::max(longest_s, static_cast<double>(monotonic_now_ns() - began_ns) * 1e-9);
  }
  const int wrong = false_poses();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0);
  add_row({"blocked log, SIGTERM",
           std::to_string(sent) + " sweeps at level trace; " + std::to_string(stops) + " stops, at most " +
               seconds_text(longest_s),
           wrong, lost, peak});
}

}  // namespace
}  // namespace pharos::host
