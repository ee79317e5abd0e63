// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "unit/host/daemon/captured_log.hpp"
#include "unit/host/daemon/fusion_fixture.hpp"

namespace pharos::host {
namespace {

using test::Fusion;
using test::kMs;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST_F(Fusion, ThePosesOfAllSourcesBecomeOneState) {
  open();
  measure(100);
  const auto all = states();
  ASSERT_FALSE(all.empty());
  const target_state_t& state = all.back();
  EXPECT_EQ(state.mode, "fused");
  EXPECT_EQ(state.target, "client");
  EXPECT_EQ(state.utime, bench.clock.utc_ns() / 1000) << "predicted to now";
  EXPECT_LT(error_m(state), 5.0 * sigma_m(state));
  EXPECT_LT(sigma_m(state), 5e-3);
  EXPECT_EQ(state.position_protection_available, 1);
  EXPECT_LT(error_m(state), state.position_protection_m);
  ASSERT_EQ(state.source_count, 3);
  EXPECT_EQ(state.sources[2].name, "ring2");
  EXPECT_EQ(state.sources[2].state, "used");
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GE(all[i].utime, all[i - 1].utime);
    EXPECT_EQ(all[i].sequence, all[i - 1].sequence + 1);
  }
  EXPECT_EQ(feed->health().at(0).state, SourceState::kOk);
  EXPECT_EQ(feed->health().at(0).identity, "mode fused");
  EXPECT_EQ(feed->health().at(0).source, "fusion/chaser");
}

TEST_F(Fusion, EveryPoseIsCountedOnce) {
  open();
  measure(50);
  const std::int64_t taken = counter("poses_taken");
  EXPECT_EQ(taken, 50 + 2 * 10);
  EXPECT_EQ(counter("poses_dropped"), 0);
  EXPECT_GT(counter("poses_late"), 0) << "cameras are late";
  EXPECT_EQ(counter("refused.too_late"), 2) << "the cameras' first poses are from before the lighthouse's";
  EXPECT_EQ(static_cast<std::int64_t>(states().size()), taken - 2) << "a state a pose";
}

TEST_F(Fusion, ASourceThatStepsIsExcludedAndTheStateGoesOn) {
  const test::CapturedLog log;
  open();
  measure(200);
  const std::size_t before = states().size();
  measure(150, 0.2);
  const auto all = states();
  bool excluded = false;
  for (std::size_t i = before; i < all.size(); ++i) {
    EXPECT_EQ(all[i].valid, 1);
    EXPECT_LT(error_m(all[i]), 0.02) << "at " << i - before;
    excluded = excluded || all[i].sources[1].state == "excluded";
  }
  EXPECT_TRUE(excluded);
  EXPECT_EQ(all.back().mode, "fused");
  EXPECT_EQ(all.back().sources[1].state, "excluded");
  const SourceHealth health = feed->health().at(0);
  EXPECT_EQ(health.state, SourceState::kDegraded);
  EXPECT_THAT(health.message, HasSubstr("not believed: tof (" + all.back().sources[1].reason + ")"));
  EXPECT_THAT(log.lines("tof is excluded"), SizeIs(1));
  measure(400);  // good again for 8 s
  EXPECT_EQ(states().back().sources[1].state, "used");
  EXPECT_THAT(log.lines("tof is believed again"), SizeIs(1));
}

TEST_F(Fusion, SilenceIsToldAsCoastingAndThenLost) {
  const test::CapturedLog log;
  open();
  measure(100);
  const double sigma_before_m = sigma_m(states().back());
  bench.sink.entries.clear();
  for (int k = 0; k < 240; ++k) look(50 * kMs);  // 12 s
  const auto all = states();
  ASSERT_EQ(all.size(), 240U);
  bool coasting = false, lost = false;
  for (const target_state_t& state : all) {
    EXPECT_FALSE(lost && state.valid != 0) << "nothing after the loss";
    coasting = coasting || state.mode == "coasting";
    lost = lost || state.mode == "lost";
    if (state.mode == "coasting") {
      EXPECT_GT(sigma_m(state), sigma_before_m);
    }
    if (state.mode != "lost") continue;
    EXPECT_EQ(state.valid, 0);
    EXPECT_EQ(state.position_m[2], 0.0);
    EXPECT_EQ(state.covariance[0], 0.0);
    for (const fused_source_t& source : state.sources) EXPECT_EQ(source.state, "silent");
  }
  EXPECT_TRUE(coasting);
  EXPECT_TRUE(lost);
  EXPECT_EQ(all.back().mode, "lost");
  EXPECT_EQ(feed->health().at(0).state, SourceState::kStale);
  EXPECT_THAT(log.lines("mode lost"), SizeIs(1));
  measure(100);
  EXPECT_EQ(states().back().mode, "fused") << "found again";
}

TEST_F(Fusion, SearchesHonestlyBeforeTheFirstPose) {
  open();
  EXPECT_EQ(feed->health().at(0).state, SourceState::kWaiting);
  look(50 * kMs);
  ASSERT_THAT(states(), SizeIs(1));
  EXPECT_EQ(states()[0].mode, "searching");
  EXPECT_EQ(states()[0].valid, 0);
  EXPECT_EQ(states()[0].sources[0].age_us, -1);
}

TEST_F(Fusion, WhatIsNotAPoseOfItsSourcesIsCountedAndNotTaken) {
  open();
  CycleReport refused;
  refused.refusal = "too_few";
  send(refused, "lighthouse/chaser");
  EXPECT_EQ(counter("poses_without_answer"), 1);
  send(tof(), "tof/other");
  TofReport other_target = tof();
  other_target.target = "debris";
  send(other_target, "tof/helios");
  BoardPoseReport board;
  static_cast<CycleReport&>(board) = lighthouse();
  send(board, "lighthouse/chaser");
  EXPECT_EQ(counter("poses_not_fused"), 3);
  TofReport other_frame = tof();
  other_frame.frames = {"world", "body"};
  send(other_frame, "tof/helios");
  EXPECT_EQ(counter("poses_other_frame"), 1);
  for (const char* flag : {"uncalibrated", "smoothed|suspect", "clock_set|no_connector"}) {
    TofReport doubtful = tof();
    doubtful.flags = flag;
    send(doubtful, "tof/helios");
  }
  EXPECT_EQ(counter("poses_doubtful"), 3);
  EXPECT_EQ(counter("poses_taken"), 0);
  EXPECT_THAT(states(), SizeIs(0));
  TofReport flat = tof();
  flat.pose.covariance.setZero();
  send(flat, "tof/helios");
  EXPECT_EQ(counter("refused.covariance"), 1);
  EXPECT_THAT(states(), SizeIs(0)) << "a refused pose has no state";
}

TEST_F(Fusion, AStationThatTheMountingDoesNotDescribeEndsTheUseOfTheLighthouse) {
  const test::CapturedLog log;
  open();
  measure(50, 0.0, false);
  EXPECT_EQ(states().back().mode, "single");
  CycleReport other = lighthouse();
  other.station = 1;
  other.sensor = "FFFF0001";
  send(other, "lighthouse/chaser");
  EXPECT_EQ(feed->health().at(0).state, SourceState::kError);
  EXPECT_THAT(feed->health().at(0).message, HasSubstr("[[vehicle.station]]"));
  measure(50, 0.0, false);
  look(kMs);
  EXPECT_EQ(states().back().valid, 0) << "which station the state was of is not known";
  EXPECT_THAT(log.lines("several stations"), SizeIs(1));
}

TEST_F(Fusion, AClockThatWasSetBackBeginsATrackAnew) {
  open();
  measure(100);
  bench.clock.advance(-3'600'000 * kMs);
  measure(100);
  EXPECT_EQ(states().back().mode, "fused");
  EXPECT_GE(counter("restarts"), 1);
}

TEST_F(Fusion, AStateThatWaitedTooLongIsNotSent) {
  open();
  measure(20);
  const std::size_t before = states().size();
  feed->look();
  bench.clock.advance(bench.config.publish.max_age_ns() + kMs);
  settle();
  EXPECT_EQ(states().size(), before);
  EXPECT_EQ(counter("states_stale"), 1);
}

}  // namespace
}  // namespace pharos::host
