// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "host/daemon/clock_step_monitor.hpp"
#include "host/daemon/frame_clock.hpp"
#include "host/daemon/stereo/pair_matcher.hpp"
#include "host/daemon/stereo/pair_source.hpp"
#include "host/runtime/latency_histogram.hpp"

namespace pharos::host {

/// Pairs of two cameras with clocks of their own: the frames' times are converted to this computer's clocks and matched
/// there. Each camera may be missing, get lost and come back at any time; frames without a partner are counted.
class CameraPairs : public PairSource {
 public:
  /// Left and right.
  using Cameras = std::array<std::unique_ptr<FrameSource>, 2>;
  CameraPairs(Cameras cameras, std::int64_t window_ns);

  std::vector<int> fds() const override { return {cameras_[0]->fd(), cameras_[1]->fd()}; }
  StereoPairPtr take() override;
  void recycle(StereoPairPtr pair) override;
  PairSourceStatus status() const override;
  std::string device() const override;
  std::string storage_error() const override;
  std::string clock_notice(std::int64_t monotonic_ns) const override;

 private:
  StereoPairPtr paired(std::size_t side, DepthFramePtr frame);
  StereoPairPtr made(std::array<TimedFrame, 2> frames);
  NamedCounts named_counts(const std::array<FrameSourceStatus, 2>& cameras) const;

  Cameras cameras_;
  std::array<FrameClock, 2> clocks_;
  std::array<ClockStepMonitor, 2> clock_steps_;
  PairMatcher matcher_;
  std::int64_t last_utc_ns_ = 0;
  std::int64_t last_steady_ns_ = 0;
  std::int64_t pairs_ = 0;
  std::int64_t unpaired_at_last_pair_ = 0;  // number of frames without a partner at the last pair
  std::int64_t pairs_time_back_ = 0;
  std::int64_t frames_no_clock_ = 0;
  std::array<LatencyHistogram, 2> transport_;  // first packet to last
  LatencyHistogram offsets_;                   // time difference of the frames of a pair
};

}  // namespace pharos::host
