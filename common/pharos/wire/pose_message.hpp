// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pharos/wire/bytes.hpp"
#include "pharos/wire/message_type.hpp"

namespace pharos::wire {

/// T_lighthouse_body. Quaternion w, x, y, z (w >= 0); metres. 56 bytes.
struct PoseFields {
  std::array<double, 4> orientation_wxyz{1.0, 0.0, 0.0, 0.0};
  std::array<double, 3> position_m{};
  bool operator==(const PoseFields&) const = default;
};

/// A second pose that fits nearly as well, and the difference in chi-squared.
struct SecondPose {
  PoseFields pose;
  float delta_chi2 = 0.0F;
  bool operator==(const SecondPose&) const = default;
};

/// The result of one cycle's solve on board.
struct PoseResult {
  PoseFields pose;
  /// Upper triangle, row by row, of the 6x6 covariance of delta (rotation rad before translation m).
  std::array<float, 21> covariance{};
  float residual_rms_rad = 0.0F;
  float adop_deg_per_rad = 0.0F;
  float pdop_m_per_rad = 0.0F;
  std::uint8_t iterations = 0;
  std::optional<SecondPose> second;
  bool operator==(const PoseResult&) const = default;
};

/// One cycle of one station solved on board: a pose, or why there is none.
struct Pose {
  static constexpr MessageType kType = MessageType::kPose;
  static constexpr std::size_t kMaxBytes = 14 + 56 + 84 + 12 + 1 + 60;

  std::int64_t time_ticks = 0;
  std::uint8_t station = 0;
  std::uint8_t flags = 0;    // of track::EpochFlag
  std::uint8_t refusal = 0;  // pose::Refusal; 0 exactly when there is a result
  std::uint16_t observations = 0;
  std::optional<PoseResult> answer;
};

void write(const Pose& message, ByteWriter& out);
void read(ByteReader& in, Pose& message);

}  // namespace pharos::wire
