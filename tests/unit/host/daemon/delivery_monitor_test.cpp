// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/delivery_monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pharos/lighthouse/optical_timing.hpp"
#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/lighthouse_pipeline_fixture.hpp"

namespace pharos::host {
namespace {

using ::testing::HasSubstr;

constexpr int kCyclesPerSecond = 60;

/// For `seconds`: a sweep of each rotor every `turns` turns, of which `kept` of every `of` are received.
std::int64_t sweep(DeliveryMonitor& monitor, int turns, int seconds, int kept, int of) {
  constexpr std::int64_t kTurn_ns = 20 * std::int64_t{lighthouse::kTurn_ticks};
  std::int64_t now_ns = 0;
  for (int i = 0; i < seconds * kCyclesPerSecond / turns; ++i) {
    lighthouse::Flash flash;
    flash.start_ticks = std::int64_t{i} * turns * lighthouse::kTurn_ticks;
    now_ns = std::int64_t{i} * turns * kTurn_ns;
    // Losses are scattered, so that some consecutive sweeps are received.
    if (i * 7 % of < kept) monitor.on_sweep(flash, now_ns);
  }
  return now_ns;
}

TEST(DeliveryMonitor, JudgesSweepsByTheTurnsOfTheRotorAlsoWhereStationsTakeTurns) {
  for (const int turns : {1, 2}) {
    DeliveryMonitor all, most, few;
    EXPECT_EQ(all.assess(sweep(all, turns, 30, 10, 10)).state, SourceState::kOk);
    const auto degraded = most.assess(sweep(most, turns, 30, 8, 10));
    EXPECT_EQ(degraded.state, SourceState::kDegraded);
    EXPECT_THAT(degraded.message, HasSubstr("% of the expected sweeps came in the last 10 s"));
    EXPECT_EQ(few.assess(sweep(few, turns, 30, 4, 10)).state, SourceState::kError);
  }
}

TEST(DeliveryMonitor, ForgetsWhatIsOlderThanItsWindow) {
  DeliveryMonitor monitor;
  for (int i = 0; i < 100; ++i) monitor.on_answer(false, i * kNsPerSecond / 10);
  EXPECT_EQ(monitor.assess(10 * kNsPerSecond).state, SourceState::kError);
  for (int i = 100; i < 210; ++i) monitor.on_answer(true, i * kNsPerSecond / 10);
  EXPECT_EQ(monitor.assess(21 * kNsPerSecond).state, SourceState::kOk);
}

class DeliveryOfATarget : public TargetPipelineTest {
 protected:
  /// One second of cycles with one sweep per frame; `lost` of every `of` frames are lost.
  void push_second(int lost, int of) {
    for (int i = 0; i < kCyclesPerSecond; ++i) {
      ticks_ += kCycle_ticks;
      for (const Axis axis : {Axis::kX, Axis::kY}) {
        const std::int64_t flash_ticks = ticks_ - (axis == Axis::kX ? 2 : 1) * StationaryTarget::kHalfTurn_ticks;
        const auto bytes = target_.bytes_of(target_.sweep(axis, flash_ticks));
        if (frame_++ * 7 % of < of - lost) push(bytes, ticks_);
      }
      pipeline_.state_changed(now_ns());
    }
  }
  test::CapturedLog log_;

 private:
  int frame_ = 0;
};

TEST_F(DeliveryOfATarget, HalfOfAllFramesLostIsNotOk) {
  for (int s = 0; s < 12; ++s) push_second(0, 10);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
  EXPECT_EQ(health().message, "");
  for (int s = 0; s < 12; ++s) push_second(5, 10);
  EXPECT_NE(health().state, SourceState::kOk);
  EXPECT_THAT(health().message, HasSubstr("50 % of the expected frames came in the last 10 s"));
  for (int s = 0; s < 12; ++s) push_second(0, 10);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
  EXPECT_GE(log_.lines("DEGRADED: ").size(), 1u);
  EXPECT_EQ(log_.lines("OK: what is expected comes again").size(), 1u);
}

TEST_F(DeliveryOfATarget, AFortiethOfAllFramesLostIsOk) {
  for (int s = 0; s < 24; ++s) push_second(1, 40);
  EXPECT_EQ(health().state, SourceState::kOk) << health().message;
}

}  // namespace
}  // namespace pharos::host
