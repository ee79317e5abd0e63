// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "host/clock/clock_map.hpp"
#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// Two frames with the same exposure time.
struct StereoPair {
  std::array<DepthFramePtr, 2> frames;  // left, right; never null
  MappedTime time;                      // the mean of both times, in this computer's clocks
  /// The same on a clock without steps, for motion between pairs. In a replay: the recorded time.
  std::int64_t steady_ns = 0;
  std::int64_t offset_ns = 0;  // right frame's time minus the left frame's
  std::int64_t complete_monotonic_ns = 0;
  bool with_pictures = false;  // of what is found in them, for people
};

/// Several estimators may share a pair.
using StereoPairPtr = std::shared_ptr<StereoPair>;

}  // namespace pharos::host
