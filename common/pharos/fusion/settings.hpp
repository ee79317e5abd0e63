// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "pharos/base/static_vector.hpp"
#include "pharos/fusion/measurement.hpp"

namespace pharos::fusion {

/// How the target moves between measurements.
enum class MotionKind : std::uint8_t {
  kFree,               // white acceleration, white angular acceleration
  kClohessyWiltshire,  // relative orbital motion about a circular orbit; attitude as kFree
  kTumbling,           // torque-free rotation with known inertia ratios; position as kFree
  kTumblingInOrbit,    // both
};

struct MotionSettings {
  MotionKind kind = MotionKind::kFree;
  /// Spectral density of the white acceleration, (m/s^2)^2 s, and angular acceleration, (rad/s^2)^2 s.
  double acceleration_density = 1e-6;
  double angular_acceleration_density = 1e-8;
  /// kFree, kClohessyWiltshire: a body free of torque, whose inertia is not known, accelerates by its own turning
  /// (Euler's equations). 1 sigma of that acceleration over the square of the rate. A symmetric top has
  /// |1 - I_a / I_t| tan(nutation) about: 0.04 where it nutates by 10 deg and the moments differ by a third.
  double gyroscopic_ratio = 0.02;
  /// Clohessy-Wiltshire: the orbit's mean motion, rad/s, and the orbital frame (x radial, y along-track, z along the
  /// orbit's normal) in the vehicle's, which the vehicle holds. The state is target minus vehicle.
  double mean_motion_rad_s = 0.0;
  Matrix3 R_vehicle_orbit = Matrix3::Identity();
  /// Tumbling: principal moments of inertia relative to any of them, and the principal axes in the target frame.
  Vector3 inertia_ratios = Vector3::Ones();
  Matrix3 R_target_principal = Matrix3::Identity();
};

/// What can be wrong with a source.
enum class FaultKind : std::uint8_t {
  kStep,
  kRamp,
  kFreeze,
  kWrongTime,
  kWrongScale,
  kMirrored,
  kWrongTarget,
  kOutliers,
  kCount,
};
inline constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::kCount);

/// In which frame a source's slow error is constant.
enum class BiasFrame : std::uint8_t {
  kSensor,   // an error of T_vehicle_sensor: its rotation acts with the lever arm to the target
  kFeature,  // an error of T_target_feature: turns with the target
};

struct SourceSettings {
  Pose<frame::Vehicle, SensorFrame> T_vehicle_sensor;
  Pose<frame::Target, FeatureFrame> T_target_feature;
  /// The feature's pose in the target is unknown and taken from the state when the source is first seen (slam): the
  /// source tells changes, not poses, and cannot begin a track.
  bool relative = false;
  BiasFrame bias_frame = BiasFrame::kSensor;
  /// Stationary covariance of the slow error (Gauss-Markov, first order; of a relative source: gained within one time
  /// constant), rotation (rad) before translation (m): what the mounting, the feature and the source's own common error
  /// leave. And its time constant.
  Matrix6 bias_covariance = Matrix6::Identity() * 1e-6;
  double bias_time_constant_s = 60.0;
  /// The source's own slow error beside bias_covariance: 1 sigma of each axis as a ratio to the sigma of an axis that
  /// the source states for its noise, of rotation and of position. It grows with range and geometry as the noise does.
  double own_rotation_ratio = 0.0;
  double own_position_ratio = 0.0;
  /// For how long the noise that the source states is alike (first-order Gauss-Markov), s: a source that filters, as
  /// the motion tracker does, tells little new with each pose. 0: poses have independent noise.
  double noise_time_s = 0.0;
  /// One standard deviation of the measurement's time, s: enters along the predicted motion.
  double time_sigma_s = 0.0;
  /// The source is silent when its last measurement is older.
  double silent_after_s = 1.0;
  /// Expected faults of each kind per hour: the prior of the protection level.
  std::array<double, kFaultKinds> faults_per_hour{1e-3, 1e-3, 1e-3, 1e-4, 1e-4, 1e-3, 1e-4, 1e-2};
};

struct IntegritySettings {
  /// Probability per hour that the truth is outside the protection level.
  double risk_per_hour = 1e-5;
  /// Errors further apart in time are independent, s; the number of looks per hour follows from it.
  double correlation_time_s = 10.0;
  /// A level beyond these is unavailable.
  double max_position_m = 1.0;
  double max_rotation_rad = 20.0 * std::numbers::pi / 180.0;
};

struct DetectionSettings {
  /// False alarms of one measurement's gate, and of one look at a solution separation.
  double gate_probability = 1e-6;
  double separation_probability = 1e-8;
  /// Excluded where the best explanation beats the next by this much of chi-squared; both in doubt (conflict) where the
  /// separation exceeds conflict_ratio times its threshold and no explanation does.
  double attribution_chi2 = 18.4;
  double conflict_ratio = 2.0;
  /// Consecutive gated measurements that end a source, and the time that they span at least.
  int gated_run = 4;
  double gated_run_s = 0.15;
  /// A source comes back after this many seconds and measurements that agree.
  double proof_s = 3.0;
  int proof_measurements = 20;
  /// After a contradiction that nothing can judge a track is told as conflict until another source has confirmed it for
  /// proof_s, or nothing has contradicted it for this long.
  double unresolved_s = 60.0;
  /// The state is lost when nothing was used for this long, or its sigmas exceed these.
  double coasting_s = 10.0;
  double max_sigma_position_m = 1.0;
  double max_sigma_rotation_rad = 0.35;
};

struct StartSettings {
  /// Measurements of one target that begin a track, and the time they may take.
  int measurements = 5;
  double window_s = 2.0;
  /// 1 sigma of the rates before anything is known of them.
  double sigma_velocity_m_s = 0.5;
  double sigma_rate_rad_s = 0.2;
};

struct Settings {
  MotionSettings motion;
  IntegritySettings integrity;
  DetectionSettings detection;
  StartSettings start;
  StaticVector<SourceSettings, kMaxSources> sources;
};

/// What is wrong with settings.
enum class SettingsError : std::uint8_t {
  kNone,
  kNoSource,
  kNoAbsoluteSource,
  kMotion,       // densities not positive, inertia ratios that no body has, no rotation
  kMounting,     // not a finite pose
  kBiasModel,    // covariance not positive definite, a time or ratio of errors out of range
  kProbability,  // a risk, probability or rate outside its range
};

SettingsError check_settings(const Settings& settings);

}  // namespace pharos::fusion
