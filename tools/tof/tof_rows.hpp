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
/// One frame's pose by paper 000, which states no uncertainty: the pose alone.
void write_paper_frame(host::RowWriter& rows, const std::string& frame, const tof::CameraFromTarget& pose);
/// The mean of a window's frames; `frame` names its last one.
void write_window(host::RowWriter& rows, const std::string& frame, const WindowMean& window);
/// A frame without a pose: `reason` is the word after refused_.
void write_refusal(host::RowWriter& rows, const std::string& frame, const std::string& reason);

/// Columns of `pharos tof --summary`, and its rows: mean, sigma, and the foretold sigma where frames state theirs.
std::vector<std::string> summary_columns();
enum class SummaryRows { kAll, kMeasured };
void write_summary(host::RowWriter& rows, const PoseSummary& summary, SummaryRows which = SummaryRows::kAll);

}  // namespace pharos::tools
