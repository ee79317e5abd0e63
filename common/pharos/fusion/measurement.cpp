// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/measurement.hpp"

#include <cmath>

namespace pharos::fusion {
namespace {

constexpr double kOrthonormal = 1e-6;   // of R^T R - I: a rotation that went through text of 7 digits
constexpr double kSymmetric = 1e-9;     // asymmetry relative to the diagonal
constexpr double kMinVariance = 1e-18;  // (1e-9 rad, 1e-9 m)^2: no source is that good; protects divisions
constexpr double kMaxVariance = 1e6;
constexpr double kMaxPosition_m = 1e6;

bool is_rotation(const Matrix3& R) {
  return (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff() < kOrthonormal && R.determinant() > 0.0;
}

bool usable(const SensorPose& pose) {
  return pose.is_finite() && is_rotation(pose.R) && pose.t.cwiseAbs().maxCoeff() < kMaxPosition_m;
}

// Cholesky's pivots of the covariance in the measured directions.
bool positive_definite(const Matrix6& covariance, const Directions& directions) {
  const Matrix6 measured = directions.rows * covariance * directions.rows.transpose();
  Matrix6 lower = Matrix6::Zero();
  for (int j = 0; j < directions.rank; ++j) {
    for (int i = j; i < directions.rank; ++i) {
      double sum = measured(i, j);
      for (int k = 0; k < j; ++k) sum -= lower(i, k) * lower(j, k);
      if (i == j) {
        if (!(sum > kMinVariance) || !(measured(j, j) < kMaxVariance) || !(sum > 1e-12 * measured(j, j))) return false;
        lower(j, j) = std::sqrt(sum);
      } else {
        lower(i, j) = sum / lower(j, j);
      }
    }
  }
  return true;
}

bool symmetric(const Matrix6& m) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double scale = std::sqrt(std::abs(m(i, i) * m(j, j)));
      if (!(std::abs(m(i, j) - m(j, i)) <= kSymmetric * scale + kMinVariance)) return false;
    }
  }
  return true;
}

bool orthonormal(const Directions& directions) {
  if (directions.rank < 1 || directions.rank > 6 || !directions.rows.allFinite()) return false;
  for (int i = 0; i < directions.rank; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double expected = i == j ? 1.0 : 0.0;
      if (std::abs(directions.rows.row(i).dot(directions.rows.row(j)) - expected) > kOrthonormal) return false;
    }
  }
  return true;
}

}  // namespace

Directions Directions::without_rotation_about(const Vector3& axis) {
  // Two unit vectors across the axis: from the coordinate axis that is farthest from it.
  Vector3::Index smallest = 0;
  axis.cwiseAbs().minCoeff(&smallest);
  const Vector3 first = axis.cross(Vector3::Unit(smallest)).normalized();
  const Vector3 other = axis.cross(first).normalized();
  Directions out;
  out.rank = 5;
  out.rows.setZero();
  out.rows.row(0).head<3>() = first.transpose();
  out.rows.row(1).head<3>() = other.transpose();
  out.rows.block<3, 3>(2, 3).setIdentity();
  return out;
}

TargetMeasurement TargetMeasurement::chosen(bool second_pose) const {
  TargetMeasurement out = *this;
  if (second_pose && second) out.pose = *second;
  out.second.reset();
  return out;
}

TargetMeasurement TargetMeasurement::as_one_of_many() const {
  TargetMeasurement out = *this;
  out.one_of_many = true;
  return out;
}

TargetMeasurement TargetMeasurement::alone() const {
  TargetMeasurement out = *this;
  out.one_of_many = false;
  return out;
}

Refusal check_measurement(const Measurement& m, std::size_t sources) {
  if (m.source >= sources) return Refusal::kUnknownSource;
  if (!usable(m.pose) || !m.covariance.allFinite()) return Refusal::kNotFinite;
  if (!std::isfinite(m.time_sigma_s) || m.time_sigma_s < 0.0F) return Refusal::kNotFinite;
  if (m.second && !usable(*m.second)) return Refusal::kNotFinite;
  if (!orthonormal(m.directions)) return Refusal::kNotFinite;
  if (!symmetric(m.covariance) || !positive_definite(m.covariance, m.directions)) return Refusal::kCovariance;
  return Refusal::kNone;
}

}  // namespace pharos::fusion
