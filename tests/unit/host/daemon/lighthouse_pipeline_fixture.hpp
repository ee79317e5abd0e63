// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/daemon/lighthouse_pipeline.hpp"
#include "integration/stationary_target.hpp"
#include "pharos/base/ticks.hpp"
#include "pharos/bearings_t.hpp"
#include "pharos/pose_t.hpp"
#include "unit/host/daemon/manual_clock.hpp"
#include "unit/host/publish/message_list.hpp"

namespace pharos::host {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr std::int64_t kCycle_ticks = StationaryTarget::kTurn_ticks;

/// A stationary target whose bytes are given directly to a LighthousePipeline; the test advances the clocks.
class TargetPipelineTest : public ::testing::Test {
 protected:
  static LighthouseFromBody pose_ahead() { return {rotation_exp(Vector3(0.2, -0.3, 0.5)), Vector3(0.3, -0.2, 2.0)}; }

  // One result per cycle, so that the test can compare the counts of inputs and outputs.
  static TargetConfig config(TrackMethod method = TrackMethod::kEpoch) {
    TargetConfig config;
    config.name = "dock";
    config.method = method;
    config.target = StationaryTarget::target();
    return config;
  }

  Arrival arrival_at(std::int64_t ticks, std::int64_t delay_ns = kMillisecond_ns) const {
    const std::int64_t monotonic_ns = start_ns_ + ticks * 20 + delay_ns;
    return {monotonic_ns + utc_minus_monotonic_ns_, monotonic_ns};
  }
  std::int64_t now_ns() const { return arrival_at(ticks_).monotonic_ns; }
  SourceHealth health() { return pipeline_.health("", SourceState::kOk, "", now_ns()); }

  // Bytes that are read `delay_ns` after the target's clock was at `ticks`.
  void push(const StationaryTarget::Bytes& bytes, std::int64_t ticks, std::int64_t delay_ns = kMillisecond_ns) {
    pipeline_.push(bytes, arrival_at(ticks, delay_ns));
  }
  void push_cycles(int count) {
    for (int i = 0; i < count; ++i) {
      ticks_ += kCycle_ticks;
      push(target_.cycle(ticks_), ticks_);
    }
  }
  std::vector<pose_t> poses() const { return list_.all<pose_t>("PHAROS_LIGHTHOUSE_POSE"); }
  std::int64_t counter(const std::string& name) {
    for (const NamedCount& count : health().counters) {
      if (count.name == name) return count.value;
    }
    ADD_FAILURE() << "no counter " << name;
    return -1;
  }

  MessageList list_;
  Publisher publisher_{list_, "PHAROS_"};
  test::ManualClock clock_;
  CalibrationMemory memory_{""};
  LighthousePipeline pipeline_{config(), PublishConfig{}, "lighthouse/test", publisher_, clock_, memory_, 0};
  StationaryTarget target_{pose_ahead()};
  std::int64_t ticks_ = 10 * kTicksPerSecond;
  std::int64_t utc_minus_monotonic_ns_ = 1'700'000'000'000'000'000;
  std::int64_t start_ns_ = 40'000 * kMillisecond_ns;  // monotonic time at which the target's clock was 0
};

}  // namespace pharos::host
