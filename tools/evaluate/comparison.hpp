// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tools/evaluate/error_figures.hpp"
#include "tools/evaluate/trajectory_file.hpp"

namespace pharos::evaluate {

enum class AlignMode { kNone, kSe3, kHandEye };

struct ComparisonOptions {
  AlignMode mode = AlignMode::kNone;
  std::optional<Alignment> known;             // of frames and bodies, with mode kNone: nothing of it is fitted
  std::optional<double> time_offset_s = 0.0;  // to add to ESTIMATE's times; none: estimate it
  std::optional<double> max_gap_s;            // none: 3.5 times TRUTH's median interval
  double relative_s = 1.0;                    // for the RPE
};

/// A comparison, or why there is none.
struct Comparison {
  std::string refused;  // empty where there is a result; else a word for the column `status`
  std::string why;      // message for the user
  Aligned aligned;
  Pairs pairs;
  AllFigures figures;
  double max_gap_s = 0.0;
  double coverage_gap_s = 0.0;  // the time between poses of ESTIMATE further apart counts as uncovered
};

/// Estimates time offset and frames as selected, and the figures of the remaining errors.
Comparison compare(const TrajectoryFile<EstimatePose>& estimate, const TrajectoryFile<TruthPose>& truth,
                   const ComparisonOptions& options);

}  // namespace pharos::evaluate
