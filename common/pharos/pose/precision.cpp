// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/precision.hpp"

#include <cmath>

#include "pharos/pose/covariance.hpp"
#include "pharos/pose/observation_table.hpp"

namespace pharos::pose {
namespace {

constexpr int kMinSensors = 3;

}  // namespace

SensorSet visible_sensors(const Target& target, const LighthouseFromBody& pose, double incidence_limit_rad) {
  SensorSet visible;
  const double min_cosine = std::cos(incidence_limit_rad);
  for (const SensorPlacement& s : target) {
    if (s.sensor >= kMaxSensors) continue;
    const Vector3 p = pose * s.position_m;
    const double distance = std::sqrt(p.squaredNorm());
    const bool facing = !s.has_normal() || (pose.R * s.normal).dot(-p) > min_cosine * distance * s.normal.norm();
    visible[s.sensor] = facing && p.z() > 0.0;
  }
  return visible;
}

Result<Precision, Refusal> precision_of(const Target& target, const LighthouseFromBody& pose, const SensorSet& sensors,
                                        double rho) {
  if (!pose.is_finite()) return Refusal::kBadInput;
  ObservationTable table;
  for (const SensorPlacement& s : target) {
    if (s.sensor >= kMaxSensors || !sensors[s.sensor]) continue;
    const Vector3 p = pose * s.position_m;
    if (!(p.z() > 0.0)) return Refusal::kBehindStation;
    const int i = table.add(s.position_m);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const double along = p[index_of(axis)], norm = std::hypot(along, p.z());
      table.see(i, axis, along / norm, p.z() / norm);
    }
  }
  table.pad();
  if (table.count < kMinSensors) return Refusal::kTooFewSensors;
  const NormalEquations normal = linearise(table, pose, Residual::kAngle);
  if (Factorisation<6>(normal.matrix).smallest_ratio() < kDegeneratePivotRatio) return Refusal::kDegenerate;
  Precision precision;
  precision.unit_covariance = unit_covariance(table, pose, Residual::kAngle, rho, normal);
  precision.adop_deg_per_rad = adop_of(precision.unit_covariance);
  precision.pdop_m_per_rad = pdop_of(precision.unit_covariance);
  return precision;
}

}  // namespace pharos::pose
