// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/types.hpp"

namespace pharos::evaluate {

/// A position at a time; of a pose table also attitude and covariance where they are there.
struct PositionSample {
  double time_s = 0.0;
  Vector3 position_m = Vector3::Zero();
  std::optional<Matrix3> R_world_body;
  std::optional<Matrix3> covariance_m2;  // of the position; from sigma_pos_mm alone: the same in all directions
  std::optional<Matrix3> attitude_covariance_rad2;  // world frame; from sigma_rot_deg alone: the same about all axes
};

struct PositionTrack {
  std::vector<PositionSample> samples;  // in the order of time
  std::size_t rows = 0;
  std::size_t refused = 0;  // without a position, or with another status than ok
};

/// Position at a time between two samples at most `max_gap_s` apart.
std::optional<Vector3> position_at(const std::vector<PositionSample>& samples, double time_s, double max_gap_s);

/// Square of the Mahalanobis distance of an error of the point `lever_m` of the body, which an error of the attitude
/// moves too (as if it had nothing in common with the position's); empty where the sample states no covariance.
std::optional<double> normalised_square(const PositionSample& estimate, const Vector3& lever_m, const Vector3& error_m);

/// Whether a file is a table of positions alone: its header has x_m and no qw.
bool is_position_table(const std::string& path);

/// Reads `time_s,x_m,y_m,z_m`, or a pose table (`time_s,qw..tz_m`, optional `status`, `sigma_pos_mm`, `sigma_rot_deg`,
/// `cov_xx_m2, cov_xy_m2, cov_xz_m2, cov_yy_m2, cov_yz_m2, cov_zz_m2`). Rows are sorted by time. Throws
/// host::InputError naming file and line.
PositionTrack read_position_track(const std::string& path);

}  // namespace pharos::evaluate
