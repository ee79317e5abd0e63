// SPDX-License-Identifier: Apache-2.0
// Half of all frames never arrive; then none: the status must say so.
#include <random>

#include "campaigns/attack/attacked_lighthouse.hpp"
#include "pharos/base/ticks.hpp"

namespace pharos::host {
namespace {

using AttackedLoss = AttackedLighthouse;

TEST_F(AttackedLoss, HalfOfAllFramesThenAll) {
  start();
  ASSERT_TRUE(measures()) << daemon.process().text();
  std::mt19937 random(1);
  std::bernoulli_distribution is_lost(0.5);
  std::int64_t cycles = 0, dropped = 0;
  const std::int64_t lost_before = daemon.counter("link.frames_lost");
  // A cycle is made and not sent: its frame numbers are missing.
  const auto drop_some = [&] {
    ++cycles;
    for (; is_lost(random); ++dropped) target.cycle(1000 * kTicksPerSecond);
    return daemon.source() != nullptr && daemon.source()->state != "ok";
  };
  ASSERT_TRUE(play_until(drop_some, 30.0)) << "the state is still ok";
  const std::string state = daemon.source()->state;
  play_until([&] { return drop_some() && cycles > 900; }, 60.0);
  const std::string later = daemon.source()->state;
  EXPECT_NE(later, "ok");
  const std::string log_before = daemon.process().text();
  const std::int64_t dark_ns = monotonic_now_ns();
  EXPECT_TRUE(
      daemon.wait([&] { return daemon.process().text().find("LOST", log_before.size()) != std::string::npos; }));
  const double told_s = static_cast<double>(monotonic_now_ns() - dark_ns) * 1e-9;
  const int wrong = false_poses();
  // Two frames a cycle; frames that are lost are counted by the next one that arrives.
  const std::int64_t uncounted = 2 * dropped - (daemon.counter("link.frames_lost") - lost_before);
  EXPECT_EQ(uncounted, 0);
  EXPECT_EQ(wrong, 0);
  add_row({"half of all frames lost, then all",
           std::to_string(dropped) + " of " + std::to_string(dropped + cycles) + " cycles: state " + state + ", then " +
               later + "; LOST after " + seconds_text(told_s),
           wrong, uncounted, memory()});
}

}  // namespace
}  // namespace pharos::host
