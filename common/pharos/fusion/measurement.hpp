// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "pharos/fusion/capacity.hpp"
#include "pharos/geometry/pose_estimate.hpp"

namespace pharos::fusion {

// Frames of a source's own pose: S, in which it measures, and F, the feature that it sees.
struct SensorFrame {};
struct FeatureFrame {};

using SensorPose = Pose<SensorFrame, FeatureFrame>;
using TargetPose = Pose<frame::Vehicle, frame::Target>;

/// The directions that were measured: rank rows of unit length, mutually orthogonal, that map the error delta of
/// Pose::moved_by to the measured quantities. A ring without a mark leaves the rotation about its axis out.
struct Directions {
  int rank = 6;
  Matrix6 rows = Matrix6::Identity();

  /// All but the rotation about `axis` (unit vector in the parent frame).
  static Directions without_rotation_about(const Vector3& axis);
  /// The fraction, 0 to 1, of the unit vector `u` that these directions hold.
  double fraction_of(const Vector6& u) const { return (rows.topRows(rank) * u).norm(); }
};

/// One pose as a source states it.
struct Measurement {
  /// Time of validity, nanoseconds on the clock that all sources share.
  std::int64_t time_ns = 0;
  std::uint8_t source = 0;
  /// One standard deviation of this measurement's time, s, beside SourceSettings::time_sigma_s.
  float time_sigma_s = 0.0F;
  SensorPose pose;
  /// Of the error delta in S, rotation (rad) before translation (m); of directions not measured it is ignored.
  Matrix6 covariance = Matrix6::Identity();
  Directions directions;
  std::optional<SensorPose> second;
};

/// A measurement in the frames of the filter.
struct TargetMeasurement {
  std::int64_t time_ns = 0;
  std::uint8_t source = 0;
  float time_sigma_s = 0.0F;
  TargetPose pose;
  Matrix6 covariance = Matrix6::Identity();
  Directions directions;
  std::optional<TargetPose> second;
  /// Variance of the mean of many such measurements over that of independent ones; >= 1.
  double correlation = 1.0;
  /// Whether a filter weighs it as one of many, whose noise is alike, or alone by what it states.
  bool one_of_many = false;

  /// With the second pose alone, or with the first.
  TargetMeasurement chosen(bool second_pose) const;
  /// As a filter has to take it that averages many: gates judge it by what it states.
  TargetMeasurement as_one_of_many() const;
  /// As the first of a filter.
  TargetMeasurement alone() const;
  /// Of the noise that a filter takes, over `covariance`.
  double noise_factor() const { return one_of_many ? correlation : 1.0; }
};

/// Why a measurement never reached the filter.
enum class Refusal : std::uint8_t {
  kNone,
  kUnknownSource,
  kNotFinite,     // a pose or covariance that is not a finite number, or a rotation that is none
  kCovariance,    // not positive definite in the measured directions, or not symmetric
  kTimeGoesBack,  // not later than the source's last one
  kTimeAhead,     // far ahead of all other sources
  kTooLate,       // older than the buffer
  kCount,
};

/// Whether the values of a measurement can be used; times are checked by the estimator.
Refusal check_measurement(const Measurement& measurement, std::size_t sources);

}  // namespace pharos::fusion
