// SPDX-License-Identifier: Apache-2.0
#include "host/receive/message_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pharos/bearings_t.hpp"
#include "pharos/clock_exchange_t.hpp"
#include "pharos/pointing_t.hpp"
#include "pharos/pose_t.hpp"
#include "pharos/preview_t.hpp"
#include "pharos/spin_t.hpp"
#include "pharos/status_t.hpp"
#include "pharos/target_state_t.hpp"

namespace pharos::host {
namespace {

// A hundred thousand kilometres: beyond it nothing is at close range.
constexpr double kMaxValue = 1e8;
// Of a quaternion that was sent as doubles.
constexpr double kUnitTolerance = 1e-3;
// Year 2200: times of arrival and of measurement can be subtracted in nanoseconds.
constexpr std::int64_t kMaxTime_us = 7'258'118'400'000'000;
constexpr int kMaxSensors = 32;
// Names are kept as keys.
constexpr std::size_t kMaxName = 200;
// As pharosd limits them.
constexpr std::size_t kMaxPreviewBytes = 32 * 1024;
constexpr std::int64_t kMaxSequence = std::int64_t{1} << 53U;

bool is_value(double value) { return std::abs(value) <= kMaxValue; }  // false for nan

template <std::size_t kSize>
bool are_values(const double (&values)[kSize]) {
  return std::all_of(values, values + kSize, is_value);
}

/// A covariance of kStates values, row by row.
template <std::size_t kStates, std::size_t kSize>
bool is_covariance(const double (&values)[kSize]) {
  static_assert(kSize == kStates * kStates);
  for (std::size_t i = 0; i < kStates; ++i) {
    if (values[i * kStates + i] < 0.0) return false;
  }
  return are_values(values);
}

bool is_sigma(double value) { return is_value(value) && value >= 0.0; }

bool is_time_us(std::int64_t value) { return value >= 0 && value <= kMaxTime_us; }

bool is_unit(const double (&q)[4]) {
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return std::abs(norm - 1.0) < kUnitTolerance;
}

template <class Message>
bool has_header(const Message& message) {
  return is_time_us(message.utime) && message.sequence >= 0 && message.sequence <= kMaxSequence &&
         message.source.size() <= kMaxName && message.target.size() <= kMaxName;
}

}  // namespace

bool is_possible(const pose_t& message) {
  if (!has_header(message)) return false;
  if (message.valid == 0) return true;
  const bool second =
      message.has_second == 0 || (are_values(message.second_position_m) && is_unit(message.second_orientation_wxyz) &&
                                  is_value(message.second_delta_chi2));
  return second && are_values(message.position_m) && is_unit(message.orientation_wxyz) &&
         is_covariance<6>(message.covariance) && is_sigma(message.sigma_rot_rad) && is_sigma(message.sigma_pos_m) &&
         is_value(message.residual_rms_rad);
}

bool is_possible(const bearings_t& message) {
  return has_header(message) &&
         std::all_of(message.bearings.begin(), message.bearings.end(), [](const bearing_t& bearing) {
           return bearing.sensor >= 0 && bearing.sensor < kMaxSensors && (bearing.axis == 0 || bearing.axis == 1) &&
                  bearing.ideal_theta_rad > 1e-3 && bearing.ideal_theta_rad < M_PI - 1e-3;
         });
}

bool is_possible(const pointing_t& message) {
  return has_header(message) &&
         (message.valid == 0 || (are_values(message.axis_station) && is_value(message.pitch_rad) &&
                                 is_value(message.yaw_rad) && is_sigma(message.sigma_axis_rad)));
}

bool is_possible(const spin_t& message) {
  return has_header(message) &&
         (message.valid == 0 || (are_values(message.rate_rad_s) && is_sigma(message.sigma_rate_rad_s)));
}

bool is_possible(const target_state_t& message) {
  const bool header = is_time_us(message.utime) && message.sequence >= 0 && message.sequence <= kMaxSequence &&
                      message.target.size() <= kMaxName;
  const bool sources = std::all_of(message.sources.begin(), message.sources.end(),
                                   [](const fused_source_t& source) { return is_value(source.normalised_innovation); });
  if (!header || !sources) return false;
  return message.valid == 0 ||
         (are_values(message.position_m) && is_unit(message.orientation_wxyz) && are_values(message.velocity_m_s) &&
          are_values(message.angular_rate_rad_s) && is_covariance<12>(message.covariance) &&
          is_value(message.position_protection_m) && is_value(message.rotation_protection_rad));
}

bool is_possible(const status_t& message) {
  return is_time_us(message.utime) && message.sequence >= 0 && message.sequence <= kMaxSequence &&
         std::all_of(message.sources.begin(), message.sources.end(), [](const source_status_t& source) {
           return is_value(source.pose_rate_hz) && is_value(source.clock_sigma_us) && is_value(source.clock_drift_ppm);
         });
}

bool is_possible(const clock_exchange_t& message) {
  constexpr std::int64_t kNsPerUs = 1000;
  return message.sender.size() <= kMaxName && message.recipient.size() <= kMaxName &&
         (message.is_answer == 0 || is_time_us(message.answered_ns / kNsPerUs));
}

bool is_possible(const preview_t& message) {
  const std::vector<std::uint8_t>& data = message.data;
  return has_header(message) && message.view.size() <= kMaxName && message.format == "jpeg" && message.width_px > 0 &&
         message.height_px > 0 && data.size() >= 4 && data.size() <= kMaxPreviewBytes && data[0] == 0xFF &&
         data[1] == 0xD8 && data[data.size() - 2] == 0xFF && data.back() == 0xD9;
}

}  // namespace pharos::host
