// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pharos/geometry/pose.hpp"

namespace pharos::frame {
/// The frame in which a source reports: L of the lighthouse, C of a camera, the rig's frame of two cameras.
struct Sensor {};
/// The frame whose pose a source reports: B of the lighthouse, T of tof, the ring of ring2, C at the first image of
/// slam.
struct Feature {};
/// The frame of the target that all sources have in common; the feature frame that is given fixes it.
struct CommonTarget {};
}  // namespace pharos::frame

namespace pharos::host {

using VehicleFromSensor = Pose<frame::Vehicle, frame::Sensor>;
using SensorFromFeature = Pose<frame::Sensor, frame::Feature>;
using TargetFromFeature = Pose<frame::CommonTarget, frame::Feature>;
using VehicleFromTarget = Pose<frame::Vehicle, frame::CommonTarget>;

enum class SourceKind : std::uint8_t { kLighthouse, kTof, kRing2, kSlam };

/// Where a value of a mounting comes from.
enum class MountingOrigin : std::uint8_t {
  kGiven,      // it defines a frame, or was measured by other means; its covariance may be zero
  kEstimated,  // `pharos calibrate mounting`; directions that the recording did not tell are listed in `unobservable`
  kPrior,      // assumed: a drawing, a guess; the covariance says how well
};

/// A fixed pose with its covariance, as written in the file.
struct MountingPose {
  MountingOrigin origin = MountingOrigin::kPrior;
  std::array<double, 4> rotation_wxyz{1.0, 0.0, 0.0, 0.0};  // length 1 within 1e-3
  std::array<double, 3> position_m{};
  /// Of the error delta in T_true = T.moved_by(delta): rotation (rad) before translation (m), in the parent frame
  /// (vehicle frame, target frame), as every covariance of Pharos. Symmetric, no negative eigenvalue; of poses that are
  /// not given every variance is positive.
  Matrix6 covariance = Matrix6::Zero();

  /// With an exactly orthonormal rotation.
  template <class PoseType>
  PoseType as() const {
    const auto& [w, x, y, z] = rotation_wxyz;
    return {Quaternion(w, x, y, z).normalized().toRotationMatrix(), Vector3(position_m.data())};
  }
  /// Rotation and position of a pose; origin and covariance stay.
  template <class PoseType>
  void set(const PoseType& pose) {
    const Quaternion q = pose.quaternion();
    rotation_wxyz = {q.w(), q.x(), q.y(), q.z()};
    position_m = {pose.t.x(), pose.t.y(), pose.t.z()};
  }
};

/// A source's own error that lasts for seconds and minutes, as a ratio to the noise that it states: so it grows with
/// range and geometry as the noise does.
struct SlowError {
  /// 1 sigma of each axis over the sigma of an axis that the source states for its rotation (root mean square of those
  /// that it measures), and over that of its position.
  double rotation_ratio = 0.0;
  double position_ratio = 0.0;
  double time_constant_s = 30.0;  // first-order Gauss-Markov
};

/// One source of poses on the vehicle: T_vehicle_target = T_vehicle_sensor T_sensor_feature T_target_feature^-1, where
/// T_sensor_feature is what the source reports.
struct SourceMounting {
  std::string name;  // 1 to 32 of a-z 0-9 _ -, unique in the file
  SourceKind kind = SourceKind::kLighthouse;
  MountingPose T_vehicle_sensor;
  /// Empty: unknown, to be estimated by whoever uses the source. Always possible for slam, whose feature frame is
  /// another one after every start.
  std::optional<MountingPose> T_target_feature;
  /// E[delta_sensor delta_feature^T], both as in MountingPose: an estimate leaves what only their product tells in
  /// both. Zero where T_target_feature is empty.
  Matrix6 cross_covariance = Matrix6::Zero();
  /// Vehicle time = the source's time stamp + time_offset_s.
  double time_offset_s = 0.0;
  double time_offset_sigma_s = 0.0;
  MountingOrigin time_offset_origin = MountingOrigin::kPrior;
  /// 1 sigma of the source's unit of length, as a ratio: its positions are true * (1 + e).
  double scale_sigma = 0.0;
  /// For how long the noise of its poses is alike, s: of a source that filters. 0: each pose has its own.
  double noise_time_s = 0.0;
  /// Empty: not known.
  std::optional<SlowError> slow_error;
  /// What the calibration could not tell, as text; these directions are at their prior.
  std::vector<std::string> unobservable;

  /// Whether its feature is where it was when the file was written: slam's is the camera's frame at its start, of which
  /// a file can only tell a former one.
  bool has_lasting_feature() const { return T_target_feature && kind != SourceKind::kSlam; }
  VehicleFromSensor vehicle_from_sensor() const { return T_vehicle_sensor.as<VehicleFromSensor>(); }
  /// Empty where it is unknown.
  std::optional<TargetFromFeature> target_from_feature() const {
    if (!T_target_feature) return std::nullopt;
    return T_target_feature->as<TargetFromFeature>();
  }
};

/// The sources of one vehicle.
struct Mounting {
  std::string rig;  // name of the vehicle or bench, for messages; may be empty
  std::vector<SourceMounting> sources;

  /// Null where no source has this name.
  const SourceMounting* find(std::string_view name) const;
};

inline constexpr std::size_t kMaxMountedSources = 16;
inline constexpr std::size_t kMaxSourceName = 32;

/// "lighthouse", "tof", "ring2", "slam".
std::string_view word_of(SourceKind kind);
std::optional<SourceKind> source_kind(std::string_view word);
/// "given", "estimated", "prior".
std::string_view word_of(MountingOrigin origin);

/// T_vehicle_target of what the source reports; empty where T_target_feature is unknown.
std::optional<VehicleFromTarget> vehicle_from_target(const SourceMounting& source, const SensorFromFeature& measured);

}  // namespace pharos::host
