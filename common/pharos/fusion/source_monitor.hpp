// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/fusion/proof.hpp"

namespace pharos::fusion {

/// What the fusion does with a source.
enum class SourceState : std::uint8_t {
  kSilent,    // nothing from it, or nothing recent
  kUsed,      // its last measurement was used
  kGated,     // its last measurement was not, for this time
  kExcluded,  // not believed, until it has agreed for a while
  kConflict,  // it or another one is wrong, and nothing tells which
};

/// Sums that tell whether innovations are those of a wrong time, or of a wrong scale: how much of their chi-squared one
/// offset along that direction explains. Older innovations are forgotten.
struct ErrorSums {
  double total = 0.0;
  double time_residual = 0.0, time_time = 0.0;
  double scale_residual = 0.0, scale_scale = 0.0;

  void add(const Innovation& innovation, const TargetMeasurement& measurement, const Kinematics& mean,
           const SourceSettings& source);
  double explained_by_time() const;
  double explained_by_scale() const;
};

/// Sum of a source's whitened innovations of the last seconds in one filter: noise cancels, a persistent disagreement
/// does not.
struct InnovationMean {
  Eigen::Matrix<float, 6, 1> sum = Eigen::Matrix<float, 6, 1>::Zero();
  float weight = 0.0F;  // sum of squared weights
  int rank = 0;
  std::int64_t last_ns = 0;

  void add(const Innovation& innovation, std::int64_t time_ns);
  /// Chi-squared of `rank` degrees of freedom where innovations are white.
  double chi2() const { return weight > 0.0F ? static_cast<double>(sum.squaredNorm() / weight) : 0.0; }
};

/// What is remembered of a source between its measurements.
struct SourceMonitor {
  bool seen = false;
  std::int64_t last_ns = 0;
  float correlation = 1.0F;  // of the last measurement's noise with its neighbours': TargetMeasurement
  SensorPose last_pose;
  int repeats = 0;  // the same pose to the last digit
  bool ever_used = false;
  std::int64_t last_used_ns = 0;
  std::int64_t joined_ns = 0;
  Directions directions;  // of its last measurement, in the vehicle frame
  double nis = 0.0;       // of its last measurement, for `rank` degrees of freedom
  int rank = 0;
  bool last_gated = false;
  bool contributed = false;  // the main filter holds information of it
  int gated_run = 0;
  std::int64_t gated_since_ns = 0;
  Vector6 gated_residual = Vector6::Zero();
  int scattered = 0;      // gated ones that disagree with the gated one before
  double outliers = 0.0;  // mean of gated (1) and used (0) over some 20 measurements
  int judged = 0;
  bool excluded = false;
  FaultKind reason = FaultKind::kStep;
  Proof proof;
  // Of an excluded source whose measurements contradict the state: variances of gated_residual, when, and for how long
  // another excluded one has said the same.
  Eigen::Matrix<float, 6, 1> contradiction_variance = Eigen::Matrix<float, 6, 1>::Zero();
  std::int64_t contradicts_ns = 0;  // 0: it does not
  int confirmed = 0;
  std::int64_t confirmed_since_ns = 0;
  ErrorSums sums;
  OwnVariance own;  // of its own slow error by the noise that it states, smoothed

  /// Whether the pose repeats the last one; noise never does.
  bool repeats_pose(const SensorPose& pose);
  void note_used(std::int64_t time_ns);
  /// `apart`: the squared distance of its residual from the last gated one, in its own sigmas.
  void note_gated(std::int64_t time_ns, const Vector6& residual, double apart);
  void exclude(FaultKind why);
  /// A measurement of an excluded source that agrees: `proof` has one more.
  void note_agreement();
  /// A measurement of an excluded source that contradicts the state, and whether another excluded source agrees with
  /// it.
  void note_contradiction(std::int64_t time_ns, bool agreed);
  /// For as long as a readmission would take.
  bool contradiction_confirmed(std::int64_t time_ns, const DetectionSettings& detection) const;
  /// The kind of fault that the last residuals look like; `slow`: found by solution separation.
  FaultKind classify(bool slow, const Vector6& residual) const;
};

}  // namespace pharos::fusion
