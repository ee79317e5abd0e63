// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/table/row_writer.hpp"
#include "pharos/tof/tof_pose.hpp"
#include "tools/tof/pose_summary.hpp"
#include "tools/tof/window_mean.hpp"

namespace pharos::tools {

/// Columns of `pharos tof`.
std::vector<std::string> tof_columns();
/// One frame's pose.
void write_frame(host::RowWriter& rows, const std::string& frame, const tof::TofPose& pose);
/// The mean of a window's frames; `frame` names its last one.
void write_window(host::RowWriter& rows, const std::string& frame, const WindowMean& window);
/// A frame without a pose: `reason` is the word after refused_.
void write_refusal(host::RowWriter& rows, const std::string& frame, const std::string& reason);

/// Columns of `pharos tof --summary`, and its rows: mean, sigma, foretold sigma.
std::vector<std::string> summary_columns();
void write_summary(host::RowWriter& rows, const PoseSummary& summary);

}  // namespace pharos::tools
