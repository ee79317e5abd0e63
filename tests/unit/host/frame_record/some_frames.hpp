// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/device/depth_frame.hpp"

namespace pharos::host::test {

inline constexpr std::int64_t kFrameUtc_ns = 1'763'721'000'000'000'000;
inline constexpr std::int64_t kFramePeriod_ns = 33'000'000;

/// Frame number k of a depth camera, or a grey one, of 6 x 4 pixels, all of them and all times other than any other's.
inline DepthFrame some_frame(int k, bool has_depth = true) {
  DepthFrame frame;
  frame.resize(6, 4);
  for (std::size_t i = 0; i < frame.intensity.size(); ++i) {
    frame.intensity[i] = static_cast<std::uint16_t>(1000 * k + static_cast<int>(i));
    frame.depth[i] = static_cast<std::uint16_t>(60'000 - 100 * k - static_cast<int>(i));
  }
  if (!has_depth) frame.depth.clear();
  frame.session = 3;
  frame.camera_ns = 5'000'000'000 + k * kFramePeriod_ns;
  frame.clock = k % 2 == 0 ? CameraClock::kOwn : CameraClock::kPtp;
  frame.taken_in_turns = k % 3 == 0;
  frame.arrival_utc_ns = kFrameUtc_ns + k * kFramePeriod_ns;
  frame.arrival_monotonic_ns = 9'000'000'000 + k * kFramePeriod_ns;
  frame.complete_monotonic_ns = frame.arrival_monotonic_ns + 7'000'000;
  if (has_depth) frame.scale = CoordinateScale{{1e-4, 1e-4, 2.5e-4}, {0.1, -0.1, 0.0}};
  return frame;
}

inline bool equal(const DepthFrame& a, const DepthFrame& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.intensity == b.intensity && a.depth == b.depth &&
         a.session == b.session && a.camera_ns == b.camera_ns && a.clock == b.clock &&
         a.taken_in_turns == b.taken_in_turns && a.arrival_utc_ns == b.arrival_utc_ns &&
         a.arrival_monotonic_ns == b.arrival_monotonic_ns && a.complete_monotonic_ns == b.complete_monotonic_ns &&
         a.scale.has_value() == b.scale.has_value() &&
         (!a.scale || (a.scale->scale_m == b.scale->scale_m && a.scale->offset_m == b.scale->offset_m));
}

}  // namespace pharos::host::test
