// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "tools/evaluate/position_track.hpp"

namespace pharos::evaluate {

struct PositionOptions {
  /// Times on ESTIMATE's clock of TRUTH's first and last row; none: found from the speeds, rates within 2 %.
  std::optional<std::pair<double, double>> marks_s;
  double window_s = 0.1;  // how far the clocks' ends are searched around
  bool estimate_lever_arm = false;
  /// Times on ESTIMATE's clock: only ESTIMATE's rows nearest to them count, an epoch is a tenth of a second that has
  /// one.
  std::optional<std::vector<double>> epochs_s;
};

/// ESTIMATE + R lever = world * TRUTH(offset + rate * time), in the least-squares sense (Arun, Huang and Blostein
/// 1987); the clock's two ends by the smallest mean error.
struct PositionComparison {
  std::string refused;  // empty where there is a result; else a word for the column `status`
  std::string why;
  std::size_t compared = 0;
  std::size_t epochs = 0, epochs_answered = 0;
  bool stationary = false;  // TRUTH stands still: frames and clocks are open, positions are compared about their mean
  double rate = 1.0;
  double offset_s = 0.0;     // of TRUTH's clock at reference_s
  double reference_s = 0.0;  // on ESTIMATE's clock
  double truth_time(double time_s) const { return reference_s + offset_s + rate * (time_s - reference_s); }
  Matrix3 R_estimate_truth = Matrix3::Identity();
  Vector3 t_estimate_truth_m = Vector3::Zero();
  Vector3 lever_m = Vector3::Zero();  // of what TRUTH follows, in ESTIMATE's body
  double mean_m = 0.0, median_m = 0.0, rms_m = 0.0, p95_m = 0.0, max_m = 0.0;
  double spread_m = 0.0;               // RMS of ESTIMATE about its own mean
  std::optional<double> nees_per_dof;  // of what TRUTH follows: the attitude's sigmas times the lever arm count too
  /// Of all rows of ESTIMATE with a covariance where TRUTH knows a position, epochs or not: those beyond five of their
  /// own sigmas (Mahalanobis distance).
  std::size_t judged = 0, beyond_5_sigmas = 0;
};

PositionComparison compare_positions(const PositionTrack& estimate, const PositionTrack& truth,
                                     const PositionOptions& options);

}  // namespace pharos::evaluate
