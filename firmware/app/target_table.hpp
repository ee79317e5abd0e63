// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace pharos::app {

/// One photodiode of the target whose poses decoder_pose solves: body frame, metres; normal zero where unknown.
struct TargetRow {
  std::uint8_t sensor = 0;
  std::array<double, 3> position_m{};
  std::array<double, 3> normal{};
};

/// All of them, from the table that PHAROS_TARGET_TABLE names when the firmware is built (TargetTable.cmake).
std::span<const TargetRow> target_table();

}  // namespace pharos::app
