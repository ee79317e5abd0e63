// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pharos/pose_t.hpp"

namespace pharos::test {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// A valid pose of a lighthouse at 2 m.
inline pose_t some_pose(std::int64_t sequence = 0) {
  pose_t pose{};
  pose.sequence = sequence;
  pose.source = "lighthouse/chaser";
  pose.target = "dock";
  pose.station_or_camera = "C33B4DE1";
  pose.parent_frame = "lighthouse";
  pose.child_frame = "body";
  pose.status = "ok";
  pose.valid = 1;
  pose.position_m[0] = 0.5;
  pose.position_m[1] = -0.25;
  pose.position_m[2] = 2.0;
  pose.orientation_wxyz[0] = 1.0;
  pose.covariance[21] = 1e-6;
  pose.sigma_pos_m = 0.001;
  pose.sigma_rot_rad = 0.002;
  return pose;
}

template <class Message>
std::vector<unsigned char> bytes_of(const Message& message) {
  std::vector<unsigned char> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

inline void append_big_endian(std::string& out, std::uint64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    out += static_cast<char>(value >> static_cast<unsigned>(shift));
}

/// One event of an LCM log, as its format's description says.
inline std::string log_event(std::int64_t number, std::int64_t utime_us, const std::string& channel,
                             const std::vector<unsigned char>& bytes) {
  std::string out;
  append_big_endian(out, 0xEDA1DA01, 4);
  append_big_endian(out, static_cast<std::uint64_t>(number), 8);
  append_big_endian(out, static_cast<std::uint64_t>(utime_us), 8);
  append_big_endian(out, channel.size(), 4);
  append_big_endian(out, bytes.size(), 4);
  return out + channel + std::string(bytes.begin(), bytes.end());
}

}  // namespace pharos::test
