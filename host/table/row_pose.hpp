// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::host {

/// Whether a pose may stand alone, without its status and flags.
enum class PoseGrade : std::uint8_t {
  kGood,
  kAmbiguous,  // a second solution fits nearly as well
  kNoTurn,     // the rotation about the target's own axis is not measured
};

/// The pose of a table's row, for forms that are not columns: a line of TUM, the covariance.
struct RowPose {
  double time_s = 0.0;
  Quaternion orientation = Quaternion::Identity();
  Vector3 position_m = Vector3::Zero();
  /// Of delta in R_true = exp([delta_rot]x) R, t_true = t + delta_pos in the parent frame; rotation (rad) before
  /// translation (m). Empty: none is stated.
  std::optional<Matrix6> covariance = std::nullopt;
  PoseGrade grade = PoseGrade::kGood;
  /// Whose poses follow each other: a station, a source. Poses of different series are not of one trajectory.
  std::string series = {};
};

/// Names of the 36 elements, row by row: cov_rx_rx_rad2, cov_rx_ry_rad2, ..., cov_rx_tx_rad_m, ..., cov_tz_tz_m2.
std::vector<std::string> covariance_columns();

}  // namespace pharos::host
