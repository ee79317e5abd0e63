// SPDX-License-Identifier: Apache-2.0
#include "pharos/geometry/target.hpp"

#include <cmath>

#include "pharos/geometry/symmetric.hpp"

namespace pharos {
namespace {

constexpr double kDuplicateDistance_m = 1e-4;
// Off the line or plane by less than this (one sigma over the sensors), a shape counts as collinear or coplanar.
constexpr double kFlatness_m = 0.5e-3;

Vector3 principal_deviations(const Target& target) {
  Vector3 mean = Vector3::Zero();
  for (const SensorPlacement& s : target) mean += s.position_m;
  mean /= static_cast<double>(target.size());
  Matrix3 scatter = Matrix3::Zero();
  for (const SensorPlacement& s : target) scatter += (s.position_m - mean) * (s.position_m - mean).transpose();
  const SymmetricEigen<3> eigen = symmetric_eigen<3>(scatter / static_cast<double>(target.size()));
  return eigen.values.reverse().cwiseMax(0.0).cwiseSqrt();
}

TargetError check_pairs(const Target& target) {
  for (std::size_t i = 0; i < target.size(); ++i) {
    for (std::size_t j = i + 1; j < target.size(); ++j) {
      if (target[i].sensor == target[j].sensor) return TargetError::kDuplicateNumber;
      if ((target[i].position_m - target[j].position_m).norm() < kDuplicateDistance_m) {
        return TargetError::kDuplicatePosition;
      }
    }
  }
  return TargetError::kNone;
}

}  // namespace

const SensorPlacement* find_sensor(const Target& target, std::uint8_t sensor) {
  for (const SensorPlacement& placement : target) {
    if (placement.sensor == sensor) return &placement;
  }
  return nullptr;
}

Result<TargetShape, TargetError> check_target(const Target& target) {
  if (target.size() < 3) return TargetError::kTooFewSensors;
  for (const SensorPlacement& s : target) {
    if (s.sensor >= kMaxSensors) return TargetError::kSensorNumberTooLarge;
    if (!s.position_m.allFinite() || !s.normal.allFinite()) return TargetError::kNotFinite;
  }
  if (const TargetError error = check_pairs(target); error != TargetError::kNone) return error;
  TargetShape shape;
  shape.sensors = target.size();
  shape.extent_m = principal_deviations(target);
  if (shape.extent_m[1] < kFlatness_m) return TargetError::kCollinear;
  shape.coplanar = shape.extent_m[2] < kFlatness_m;
  return shape;
}

const char* describe(TargetError error) {
  switch (error) {
    case TargetError::kNone:
      return "no error";
    case TargetError::kTooFewSensors:
      return "fewer than three sensors";
    case TargetError::kDuplicateNumber:
      return "the same sensor number twice";
    case TargetError::kDuplicatePosition:
      return "two sensors within 0.1 mm of one another";
    case TargetError::kSensorNumberTooLarge:
      return "a sensor number above 31";
    case TargetError::kNotFinite:
      return "a coordinate that is not a finite number";
    case TargetError::kCollinear:
      return "all sensors on one line";
  }
  return "unknown error";
}

}  // namespace pharos
