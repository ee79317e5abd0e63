// SPDX-License-Identifier: Apache-2.0
// Thousands of signals while poses come.
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "campaigns/attack/attacked_lighthouse.hpp"

namespace pharos::host {
namespace {

using AttackedBySignals = AttackedLighthouse;

TEST_F(AttackedBySignals, OfEveryKindThatMeansNoEnd) {
  constexpr std::array kSignals{SIGUSR1, SIGUSR2,   SIGALRM, SIGHUP, SIGIO,
                                SIGPIPE, SIGVTALRM, SIGPROF, SIGPWR, SIGWINCH};
  const std::int64_t count = campaign_size("PHAROS_ATTACK_SIGNALS", 20'000);
  start();
  ASSERT_TRUE(measures()) << daemon.process().text();
  std::atomic<std::int64_t> sent = 0;
  std::atomic<bool> ended = false;
  std::thread storm([&] {
    for (; sent < count && !ended; ++sent) {
      daemon.process().signal(kSignals[static_cast<std::size_t>(sent) % kSignals.size()]);
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    ended = true;
  });
  play_until([&] { return ended.load(); }, 300.0);
  ended = true;
  storm.join();
  const int wrong = false_poses();
  const std::int64_t lost = lost_poses();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(lost, 0) << reasons();
  EXPECT_TRUE(runs()) << daemon.process().text();
  add_row(
      {"signal storm",
       std::to_string(sent.load()) + " signals, a tenth SIGHUP, during " + std::to_string(sweeps_sent()) + " sweeps",
       wrong, lost, memory()});
  EXPECT_EQ(stop(), 0);
}

}  // namespace
}  // namespace pharos::host
