// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/evaluate/alignment.hpp"

namespace pharos::evaluate {

/// The error of one pose: (25) of paper 002 is the norm of each half.
struct PoseError {
  double time_s = 0.0;  // on ESTIMATE's clock
  Vector3 rotation_rad = Vector3::Zero();
  Vector3 position_m = Vector3::Zero();
  std::optional<double> sigma_rotation_rad;
  std::optional<double> sigma_position_m;
};

std::vector<PoseError> errors_of(const std::vector<Pair>& pairs, const Alignment& alignment);

/// Root mean square, quantiles and maximum of error norms.
struct Distribution {
  double rms = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};
Distribution distribution_of(std::vector<double> norms);

/// Stated sigma (square root of a trace) compared with real errors.
struct Consistency {
  std::array<double, 3> within{};  // fraction of errors up to 1, 2 and 3 sigma
  double normalised_square =
      0.0;  // mean of (error / sigma)^2: 1 where sigmas are consistent, more where they are too small
};

/// Figures of rotation (rad) or position (m).
struct Figures {
  Distribution error;                      // (25)
  double spread = 0.0;                     // (23): rms of errors about their mean, independent of a constant offset
  std::optional<Consistency> consistency;  // where every compared pose states a sigma; 0 is not judged
  std::optional<double> relative;          // RPE: rms error of the motion over a time
};

struct AllFigures {
  Figures rotation;  // rad
  Figures position;  // m
  /// RMS position error after a least-squares fit of the paths (rotation and offset), m: the ATE of trajectory tools.
  double ate_m = 0.0;
  std::size_t relative_pairs = 0;
  /// Fraction of the time common to both recordings in which compared poses are no further apart than the gap allowed.
  double coverage = 0.0;
};

/// Time span common to ESTIMATE (all rows, on its own clock) and TRUTH; empty where end < begin.
struct CommonSpan {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// Figures of at least one pair. `relative_s`: time over which motion errors are taken; `max_gap_s`: largest distance
/// of poses for which the time between them counts as covered.
AllFigures figures_of(const std::vector<Pair>& pairs, const Alignment& alignment, CommonSpan span, double relative_s,
                      double max_gap_s);

}  // namespace pharos::evaluate
