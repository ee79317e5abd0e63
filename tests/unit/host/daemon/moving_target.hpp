// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "host/config/daemon_config.hpp"
#include "host/publish/messages.hpp"
#include "pharos/target_state_t.hpp"
#include "unit/host/daemon/fusion_fixture.hpp"

namespace pharos::host::test {

/// The vehicle of fusion_fixture.hpp with its cameras on another computer.
inline VehicleConfig a_vehicle_with_remotes() {
  VehicleConfig config = a_vehicle();
  for (std::size_t s : {1U, 2U}) {
    config.sources[s].is_remote = true;
    config.sources[s].source = s == 1 ? "remote/depth" : "remote/ring";
  }
  return config;
}

inline std::vector<RemoteConfig> two_remotes() {
  RemoteConfig depth;
  depth.name = "depth";
  depth.channel = "PHAROS_TOF_POSE";
  depth.source = "tof/helios";
  depth.target = "client";
  depth.frame = "camera";
  depth.feature = "target";
  depth.daemon = "cameras";
  RemoteConfig ring = depth;
  ring.name = "ring";
  ring.channel = "PHAROS_RING2_POSE";
  ring.source = "ring2/bow";
  ring.kind = SourceKind::kRing2;
  ring.frame = "rig";
  return {depth, ring};
}

/// A target that approaches and tumbles, and what three sources measure of it: of one instant always the same, on
/// whatever computer.
class MovingTarget {
 public:
  explicit MovingTarget(const VehicleConfig& vehicle) : vehicle_(vehicle) {}

  CycleReport lighthouse(std::int64_t time_ns) const {
    CycleReport report;
    report.sensor = "0A1B2C3D";
    report.pose = measured<LighthousePoseEstimate>(0, time_ns);
    return report;
  }
  TofReport tof(std::int64_t time_ns) const {
    TofReport report;
    report.pose = measured<TofPoseEstimate>(1, time_ns);
    return report;
  }
  StereoReport ring2(std::int64_t time_ns) const {
    StereoReport report(measured<Ring2PoseEstimate>(2, time_ns));
    report.flags = "no_connector";
    return report;
  }
  static VehicleFromTarget at(double time_s) {
    const VehicleFromTarget start = truth();
    const Vector3 rate_rad_s = Vector3(0.4, 0.8, -0.4).normalized() * (4.0 * std::numbers::pi / 180.0);
    return {rotation_exp(rate_rad_s * time_s) * start.R, Vector3(start.t + Vector3(0.02, -0.01, -0.06) * time_s)};
  }

 private:
  template <class Estimate>
  Estimate measured(std::size_t s, std::int64_t time_ns) const {
    const SourceMounting& mounting = vehicle_.sources[s].mounting;
    const VehicleFromTarget target = at(static_cast<double>(time_ns) * 1e-9);
    SensorFromFeature pose = mounting.vehicle_from_sensor().inverse() * target * *mounting.target_from_feature();
    std::mt19937_64 random(static_cast<std::uint64_t>(time_ns) * 8 + s);
    std::normal_distribution<double> normal;
    Vector6 noise;
    for (int i = 0; i < 6; ++i) noise[i] = (i < 3 ? kSigma_rad : kSigma_m) * normal(random);
    pose = pose.moved_by(noise);
    Estimate out;
    out.pose.R = pose.R;
    out.pose.t = pose.t;
    out.covariance.setZero();
    for (int i = 0; i < 6; ++i) out.covariance(i, i) = i < 3 ? kSigma_rad * kSigma_rad : kSigma_m * kSigma_m;
    return out;
  }

  VehicleConfig vehicle_;
};

/// Errors of fused states from 5 s of the approach on, as root mean square.
class StateErrors {
 public:
  /// Any bytes of a channel; `start_us`: UTC of the approach's beginning.
  void add(const std::string& channel, const std::uint8_t* bytes, std::size_t count, std::int64_t start_us) {
    target_state_t state;
    const auto size = static_cast<int>(count);
    if (channel != "PHAROS_TARGET_STATE" || state.decode(bytes, 0, size) != size || state.valid == 0) return;
    const double time_s = static_cast<double>(state.utime - start_us) * 1e-6;
    if (time_s < 5.0) return;
    const VehicleFromTarget target = MovingTarget::at(time_s);
    const double* q = state.orientation_wxyz;
    const Matrix3 R = Quaternion(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    position_m2_ += (Vector3(state.position_m) - target.t).squaredNorm();
    rotation_rad2_ += rotation_log(Matrix3(R * target.R.transpose())).squaredNorm();
    ++states_;
  }
  double position_m() const { return std::sqrt(position_m2_ / states_); }
  double rotation_rad() const { return std::sqrt(rotation_rad2_ / states_); }
  int states() const { return states_; }

 private:
  double position_m2_ = 0.0, rotation_rad2_ = 0.0;
  int states_ = 0;
};

}  // namespace pharos::host::test
