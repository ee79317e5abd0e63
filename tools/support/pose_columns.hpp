// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::tools {

/// `first`, then qw..tz_m, then `last`: the columns of a pose table.
std::vector<std::string> with_pose_columns(std::vector<std::string> first, const std::vector<std::string>& last);
/// The columns that an ambiguous pose fills: alt_qw..alt_tz_m,delta_chi2.
std::vector<std::string> second_solution_columns();

/// Fields qw..tz_m (quaternion with w >= 0).
void write_pose(host::RowWriter& rows, const LighthouseFromBody& T_lighthouse_body);
/// The row's pose for covariance and TUM; poses of one `series` are of one trajectory.
host::RowPose row_pose(const LighthousePoseEstimate& estimate, double time_s, std::string series);
/// Fields qw..tz_m without values.
void write_no_pose(host::RowWriter& rows);
/// Fields alt_qw..delta_chi2: filled exactly when the pose is ambiguous. Null for a refused pose.
void write_second_solution(host::RowWriter& rows, const LighthousePoseEstimate* estimate);

/// `ok`, `ambiguous` or `refused_<reason>`.
std::string status_of(const Result<LighthousePoseEstimate, pose::Refusal>& pose);

}  // namespace pharos::tools
