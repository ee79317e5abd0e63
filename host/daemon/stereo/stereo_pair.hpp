// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "host/clock/clock_map.hpp"
#include "host/device/depth_frame.hpp"

namespace pharos::host {

/// Two frames of one instant.
struct StereoPair {
  std::array<DepthFramePtr, 2> frames;  // left, right; never null
  MappedTime time;                      // the middle of both, in this computer's clocks
  /// The same on a clock that nobody sets, for what moves between pairs. Of a recording: its own.
  std::int64_t steady_ns = 0;
  std::int64_t offset_ns = 0;  // of the right frame after the left one
  std::int64_t complete_monotonic_ns = 0;
};

/// Several estimators may look at one pair.
using StereoPairPtr = std::shared_ptr<StereoPair>;

}  // namespace pharos::host
