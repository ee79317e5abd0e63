// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "tools/listen/received_pose.hpp"

namespace pharos::tools {

/// Time of day, UTC, to the millisecond.
std::string clock_text(std::int64_t utime_us);

/// Rotation vector in degrees, of cameras the angles of paper 000; the pose is there.
std::string attitude_text(const ReceivedPose& pose);

/// One line of text: UTC, target, station, position in mm, rotation vector in degrees (of cameras: the
/// angles of paper 000), sigmas, rate, age, error.
std::string pose_line(const ReceivedPose& pose);

/// Columns of the tables (CSV, JSON), and one row of them.
std::vector<std::string> pose_columns();
void write_pose_row(host::RowWriter& rows, const ReceivedPose& pose);

}  // namespace pharos::tools
