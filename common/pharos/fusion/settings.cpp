// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/settings.hpp"

#include <cmath>

#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::fusion {
namespace {

constexpr double kMaxTimeSigma_s = 1e6;
constexpr double kMaxNoiseTime_s = 10.0;  // longer is a slow error; its weight would silence the source

bool is_rotation_matrix(const Matrix3& R) {
  return R.allFinite() && (R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         R.determinant() > 0.0;
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool probability(double value) { return value > 0.0 && value < 1.0; }

bool motion_is_usable(const MotionSettings& m) {
  if (!positive(m.acceleration_density) || !positive(m.angular_acceleration_density)) return false;
  if (!(m.gyroscopic_ratio >= 0.0 && m.gyroscopic_ratio <= 1.0)) return false;
  if (!is_rotation_matrix(m.R_vehicle_orbit) || !is_rotation_matrix(m.R_target_principal)) return false;
  if ((m.kind == MotionKind::kClohessyWiltshire || m.kind == MotionKind::kTumblingInOrbit) &&
      !(positive(m.mean_motion_rad_s) && m.mean_motion_rad_s < 0.01)) {  // 0.00124 rad/s at the Earth's surface
    return false;
  }
  // Moments of a rigid body: each at most the sum of the other two.
  const Vector3& I = m.inertia_ratios;
  return I.allFinite() && I.minCoeff() > 0.0 && I.maxCoeff() <= (I.sum() - I.maxCoeff()) * (1.0 + 1e-9);
}

SettingsError check_source(const SourceSettings& source) {
  if (!source.T_vehicle_sensor.is_finite() || !is_rotation_matrix(source.T_vehicle_sensor.R))
    return SettingsError::kMounting;
  if (!source.T_target_feature.is_finite() || !is_rotation_matrix(source.T_target_feature.R))
    return SettingsError::kMounting;
  if (!source.bias_covariance.allFinite() || !positive_inverse<6>(source.bias_covariance))
    return SettingsError::kBiasModel;
  if (!positive(source.bias_time_constant_s)) return SettingsError::kBiasModel;
  for (const double ratio : {source.own_rotation_ratio, source.own_position_ratio}) {
    if (!(ratio >= 0.0) || !std::isfinite(ratio)) return SettingsError::kBiasModel;
  }
  if (!(source.time_sigma_s >= 0.0 && source.time_sigma_s <= kMaxTimeSigma_s)) return SettingsError::kBiasModel;
  if (!(source.noise_time_s >= 0.0 && source.noise_time_s <= kMaxNoiseTime_s)) return SettingsError::kBiasModel;
  if (!positive(source.silent_after_s)) return SettingsError::kBiasModel;
  for (const double rate : source.faults_per_hour) {
    if (!(rate >= 0.0) || !std::isfinite(rate)) return SettingsError::kProbability;
  }
  return SettingsError::kNone;
}

}  // namespace

SettingsError check_settings(const Settings& settings) {
  if (settings.sources.empty()) return SettingsError::kNoSource;
  if (!motion_is_usable(settings.motion)) return SettingsError::kMotion;
  bool absolute = false;
  for (const SourceSettings& source : settings.sources) {
    const SettingsError error = check_source(source);
    if (error != SettingsError::kNone) return error;
    absolute = absolute || !source.relative;
  }
  if (!absolute) return SettingsError::kNoAbsoluteSource;
  const IntegritySettings& integrity = settings.integrity;
  const DetectionSettings& detection = settings.detection;
  if (!probability(integrity.risk_per_hour) || !positive(integrity.correlation_time_s) ||
      !probability(detection.gate_probability) || !probability(detection.separation_probability)) {
    return SettingsError::kProbability;
  }
  return SettingsError::kNone;
}

}  // namespace pharos::fusion
