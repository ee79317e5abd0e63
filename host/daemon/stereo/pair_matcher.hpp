// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "host/clock/clock_map.hpp"
#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// A frame and its exposure time.
struct TimedFrame {
  DepthFramePtr frame;
  MappedTime time;
};

/// Matches frames of two cameras to pairs: the nearest in time within a window. The frames of each camera come in the
/// order of their times; one camera's may arrive later than the other's by up to kMaxWaiting frames.
class PairMatcher {
 public:
  /// Maximum number of waiting frames of a camera, 0.2 s at 20 frames/s; the oldest is given up for a newer one.
  static constexpr std::size_t kMaxWaiting = 4;

  /// `give_up` is called for every frame that remains without a partner, with its side: 0 (left) or 1.
  PairMatcher(std::int64_t window_ns, std::function<void(std::size_t side, DepthFramePtr frame)> on_unpaired)
      : window_ns_(window_ns), on_unpaired_(std::move(on_unpaired)) {}

  /// The pair (left, right) that this frame completes, if any.
  std::optional<std::array<TimedFrame, 2>> push(std::size_t side, TimedFrame frame);
  /// Gives up all waiting frames, as the time base has changed.
  void clear();

  /// Number of frames given up so far.
  std::int64_t unpaired(std::size_t side) const { return unpaired_[side]; }

 private:
  void drop_oldest(std::size_t side);

  std::int64_t window_ns_;
  std::function<void(std::size_t, DepthFramePtr)> on_unpaired_;
  std::array<std::deque<TimedFrame>, 2> waiting_;
  std::array<std::int64_t, 2> unpaired_{};
};

}  // namespace pharos::host
