// SPDX-License-Identifier: Apache-2.0
#include "host/fusion/fusion_settings.hpp"

#include "pharos/base/units.hpp"

namespace pharos::host {
namespace {

// A relative source's slow error is a random walk: what slam gains within one time constant.
constexpr double kRelativeBias_rad = 0.3 / kDegPerRad;
constexpr double kRelativeBias_m = 5e-3;
// What is left of a source whose slow error is stated and whose mounting is given: no error at all makes no covariance.
constexpr double kMinBias_rad = 1e-6;
constexpr double kMinBias_m = 1e-6;

fusion::MotionKind motion_kind(const std::string& word) {
  if (word == "orbit") return fusion::MotionKind::kClohessyWiltshire;
  if (word == "tumbling") return fusion::MotionKind::kTumbling;
  if (word == "tumbling_orbit") return fusion::MotionKind::kTumblingInOrbit;
  return fusion::MotionKind::kFree;
}

Matrix6 diagonal(double rotation, double position) {
  Vector6 sigma;
  sigma << Vector3::Constant(rotation), Vector3::Constant(position);
  return sigma.cwiseAbs2().asDiagonal();
}

// Where a source states its own slow error the estimator adds it to each measurement's.
Matrix6 own_bias(const SourceMounting& mounting, const FusionChoices& choices) {
  if (mounting.slow_error) return diagonal(kMinBias_rad, kMinBias_m);
  return diagonal(choices.bias_deg / kDegPerRad, choices.bias_mm / kMmPerM);
}

void set_slow_error(const SourceMounting& mounting, fusion::SourceSettings& out) {
  const SlowError& slow = *mounting.slow_error;
  out.own_rotation_ratio = slow.rotation_ratio;
  out.own_position_ratio = slow.position_ratio;
  out.bias_time_constant_s = slow.time_constant_s;
  // Without an error of its mounting only the source's own is left, and that is one of the pose: no lever arm.
  const bool exact =
      mounting.T_vehicle_sensor.covariance.isZero(0.0) && mounting.T_target_feature->covariance.isZero(0.0);
  if (exact) out.bias_frame = fusion::BiasFrame::kFeature;
}

// Errors of both fixed poses as one error of T_vehicle_sensor: e_sensor + A e_feature at the target's present pose.
Matrix6 mounting_covariance(const SourceMounting& mounting, const TargetFromFeature& T_target_feature,
                            const SensorFromFeature& first) {
  const VehicleFromSensor T_vehicle_sensor = mounting.vehicle_from_sensor();
  const VehicleFromTarget target = T_vehicle_sensor * first * T_target_feature.inverse();
  Matrix6 by_feature = Matrix6::Zero();  // error of T_vehicle_target by that of T_target_feature
  by_feature.topLeftCorner<3, 3>() = -target.R;
  by_feature.bottomLeftCorner<3, 3>() = -target.R * skew(T_target_feature.t);
  by_feature.bottomRightCorner<3, 3>() = -target.R;
  Matrix6 from_sensor = Matrix6::Identity();  // that by T_vehicle_sensor's, inverted
  from_sensor.bottomLeftCorner<3, 3>() = skew(target.t - T_vehicle_sensor.t);
  const Matrix6 A = from_sensor * by_feature;
  const Matrix6 cross = mounting.cross_covariance * A.transpose();
  Matrix6 sum = mounting.T_vehicle_sensor.covariance + A * mounting.T_target_feature->covariance * A.transpose() +
                cross + cross.transpose();
  Vector6 scale;
  scale << Vector3::Zero(), mounting.scale_sigma * (target.t - T_vehicle_sensor.t);
  sum += scale * scale.transpose();
  return 0.5 * (sum + sum.transpose());
}

}  // namespace

fusion::Settings fusion_settings(const FusionChoices& choices) {
  fusion::Settings settings;
  settings.motion.kind = motion_kind(choices.motion);
  settings.motion.mean_motion_rad_s = choices.mean_motion_rad_s;
  settings.motion.inertia_ratios = Vector3(choices.inertia.data());
  settings.motion.acceleration_density = choices.acceleration_density;
  settings.motion.angular_acceleration_density = choices.angular_acceleration_density;
  settings.integrity.risk_per_hour = choices.risk_per_hour;
  return settings;
}

fusion::SourceSettings source_settings(const SourceMounting& mounting, const FusionChoices& choices) {
  fusion::SourceSettings out;
  const VehicleFromSensor sensor = mounting.vehicle_from_sensor();
  out.T_vehicle_sensor = {sensor.R, sensor.t};
  out.bias_time_constant_s = choices.bias_time_s;
  out.time_sigma_s = mounting.time_offset_sigma_s;
  out.noise_time_s = mounting.noise_time_s;
  out.faults_per_hour.fill(choices.faults_per_hour);
  if (!mounting.has_lasting_feature()) {
    out.relative = true;
    out.bias_frame = fusion::BiasFrame::kFeature;
    out.bias_covariance = diagonal(kRelativeBias_rad, kRelativeBias_m);
    return out;
  }
  const TargetFromFeature feature = *mounting.target_from_feature();
  out.T_target_feature = {feature.R, feature.t};
  out.bias_covariance = own_bias(mounting, choices);
  if (mounting.slow_error) set_slow_error(mounting, out);
  return out;
}

Matrix6 source_bias(const SourceMounting& mounting, const SensorFromFeature& first, const FusionChoices& choices) {
  return own_bias(mounting, choices) + mounting_covariance(mounting, *mounting.target_from_feature(), first);
}

const char* words_of(fusion::SettingsError error) {
  switch (error) {
    case fusion::SettingsError::kNoAbsoluteSource:
      return "no source whose feature is known on the target (T_target_feature)";
    case fusion::SettingsError::kMotion:
      return "motion: densities, mean motion (0 to 0.01 rad/s) or moments of inertia that no body has";
    case fusion::SettingsError::kMounting:
      return "a mounting that is no pose";
    case fusion::SettingsError::kBiasModel:
      return "a bias whose covariance or time constant is not positive";
    case fusion::SettingsError::kProbability:
      return "a probability or rate outside of its range";
    default:
      return "no source";
  }
}

}  // namespace pharos::host
