// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tools/evaluation/comparison/comparison.hpp"
#include "tools/evaluation/report/part.hpp"
#include "tools/evaluation/reproduce/lighthouse/calibration_session.hpp"

namespace pharos::tools {

struct DynamicRunsOptions {
  int runs = 10;  // as the paper; the table has no more
  double run_s = 60.0;
  CalibrationSession calibration;
  std::uint64_t seed = 1;
};

/// Paper 002, section 4.3 and table 2: a target flown through 4 m x 4 m x 2 m, compared with the truth. With the
/// paper's noise and the workshop errors (drawn for each run). Theirs: the paper's method as printed (paper_pose.hpp).
/// Ours: calibrated and motion-aware, answers of docking quality. Between them, as further columns: the paper's method
/// calibrated, and motion-aware tracking uncalibrated. With `folder` also figures 6 and 7, of the first run.
report::PartResult reproduce_dynamic_runs(const DynamicRunsOptions& options, const std::filesystem::path& folder = {});

}  // namespace pharos::tools
