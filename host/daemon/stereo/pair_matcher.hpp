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

/// A frame and when it was taken.
struct TimedFrame {
  DepthFramePtr frame;
  MappedTime time;
};

/// Frames of two cameras to pairs by their times: the nearest within a window. Each camera's come in the order of their
/// times; how far one camera's lag behind the other's in arriving does not matter, up to kMaxWaiting frames.
class PairMatcher {
 public:
  /// A frame waits for its partner as long as so many newer ones of its camera do not: 0.2 s at 20 frames/s.
  static constexpr std::size_t kMaxWaiting = 4;

  /// `give_up` gets every frame that remains without a partner: side 0 (left) or 1.
  PairMatcher(std::int64_t window_ns, std::function<void(std::size_t side, DepthFramePtr frame)> on_unpaired)
      : window_ns_(window_ns), on_unpaired_(std::move(on_unpaired)) {}

  /// The pair (left, right) that this frame completes.
  std::optional<std::array<TimedFrame, 2>> push(std::size_t side, TimedFrame frame);
  /// Gives up all that wait: times begin anew.
  void clear();

  /// Frames given up so far.
  std::int64_t unpaired(std::size_t side) const { return unpaired_[side]; }

 private:
  void drop_oldest(std::size_t side);

  std::int64_t window_ns_;
  std::function<void(std::size_t, DepthFramePtr)> on_unpaired_;
  std::array<std::deque<TimedFrame>, 2> waiting_;
  std::array<std::int64_t, 2> unpaired_{};
};

}  // namespace pharos::host
