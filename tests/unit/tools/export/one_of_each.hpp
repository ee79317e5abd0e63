// SPDX-License-Identifier: Apache-2.0
#pragma once

// One message of each type.
#include <cstdint>
#include <string>
#include <vector>

#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"
#include "tests/support/lcm_log.hpp"

namespace pharos::test {

inline constexpr std::int64_t kSomeTime_us = 1'700'000'000'123'456;

inline pose_t some_pose(int number) {
  pose_t pose{};
  pose.utime = kSomeTime_us + 8333 * number;
  pose.sequence = number;
  pose.source = "lighthouse/chaser";
  pose.station_or_camera = "BEC08E38";
  pose.target = "dock";
  pose.parent_frame = "lighthouse";
  pose.child_frame = "body";
  pose.status = "ok";
  pose.valid = 1;
  pose.flags = "fused|outliers";
  for (int k = 0; k < 3; ++k) pose.position_m[k] = 0.1 * k + 1e-3 * number;
  pose.orientation_wxyz[0] = 0.8;
  pose.orientation_wxyz[2] = -0.6;
  for (int k = 0; k < 36; ++k) pose.covariance[k] = 1e-8 * (k / 7 + k % 6);
  pose.sigma_rot_rad = 1.0 / 3.0;
  return pose;
}

inline status_t some_status() {
  status_t status{};
  status.utime = kSomeTime_us;
  status.host = "chase";
  status.state = "degraded";
  status.message = "one \"quoted\" word";
  status.counters = {{"poses_published", 12}, {"bytes", 1LL << 40}};
  status.counter_count = 2;
  source_status_t source{};
  source.source = "tof/helios";
  source.state = "stale";
  source.pose_age_us = -1;
  source.pose_rate_hz = 9.75;
  source.counters = {{"frames", 3}};
  source.counter_count = 1;
  status.sources = {source, source_status_t{}};
  status.sources[1].source = "lighthouse/chaser";
  status.source_count = 2;
  return status;
}

inline bearings_t some_bearings() {
  bearings_t bearings{};
  bearings.utime = kSomeTime_us;
  bearings.source = "lighthouse/chaser";
  bearings.calibrated = 1;
  bearings.bearings.resize(3);
  for (std::int8_t k = 0; k < 3; ++k) {
    bearings.bearings[static_cast<std::size_t>(k)].sensor = k;
    bearings.bearings[static_cast<std::size_t>(k)].raw_theta_rad = 1.5 + 0.01 * k;
  }
  bearings.count = 3;
  return bearings;
}

inline target_state_t some_state() {
  target_state_t state{};
  state.utime = kSomeTime_us;
  state.sequence = 5;
  state.target = "dock";
  state.mode = "fused";
  state.valid = 1;
  state.position_m[2] = 2.5;
  state.orientation_wxyz[0] = 0.8;
  state.orientation_wxyz[2] = -0.6;
  for (int k = 0; k < 144; ++k) state.covariance[k] = 1e-9 * k;
  state.sources.resize(1);
  state.sources[0].name = "tof";
  state.sources[0].reason = "step";
  state.source_count = 1;
  return state;
}

/// Every byte there is, as the picture.
inline preview_t some_preview(const std::string& source, const std::string& view) {
  preview_t preview{};
  preview.utime = kSomeTime_us;
  preview.sequence = 9;
  preview.source = source;
  preview.view = view;
  preview.status = "ok";
  preview.width_px = 640;
  preview.height_px = 480;
  preview.format = "jpeg";
  for (int k = 0; k < 256; ++k) preview.data.push_back(static_cast<std::uint8_t>(k));
  preview.size = 256;
  return preview;
}

}  // namespace pharos::test
