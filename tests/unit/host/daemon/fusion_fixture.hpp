// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "host/daemon/fusion/fusion_feed.hpp"
#include "host/publish/messages.hpp"
#include "unit/host/daemon/source_bench.hpp"

namespace pharos::host::test {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr double kSigma_m = 1e-3;
inline constexpr double kSigma_rad = 1e-3;

inline VehicleFromTarget truth() { return {rotation_exp(Vector3(0.1, -0.2, 0.3)), {0.1, 0.2, 2.0}}; }

inline SourceMounting mounting_of(const std::string& name, SourceKind kind, const Vector3& place, const Vector3& turn) {
  SourceMounting mounting;
  mounting.name = name;
  mounting.kind = kind;
  mounting.T_vehicle_sensor.origin = MountingOrigin::kGiven;
  mounting.T_vehicle_sensor.set(VehicleFromSensor{rotation_exp(turn), place});
  mounting.T_target_feature.emplace();
  mounting.T_target_feature->origin = MountingOrigin::kGiven;
  mounting.T_target_feature->set(TargetFromFeature{rotation_exp(Vector3(0.3, 0.0, 0.1)), {0.0, 0.1, 0.0}});
  return mounting;
}

inline VehicleConfig a_vehicle() {
  VehicleConfig config;
  config.target = "client";
  config.rate_hz = 1e-3;  // tests look themselves
  config.sources.push_back(
      {mounting_of("lighthouse", SourceKind::kLighthouse, {0.0, 0.3, 0.0}, {0.0, 0.1, 0.0}), "lighthouse", ""});
  config.sources.push_back({mounting_of("tof", SourceKind::kTof, {0.3, 0.0, 0.1}, {0.1, 0.0, 0.0}), "tof/helios", ""});
  config.sources.push_back(
      {mounting_of("ring2", SourceKind::kRing2, {-0.3, 0.0, 0.0}, {0.0, 0.0, 0.2}), "ring2/bow", ""});
  return config;
}

/// A stationary target, and what three sources publish of it.
class Fusion : public ::testing::Test {
 protected:
  explicit Fusion(const VehicleConfig& vehicle = a_vehicle()) : vehicle_(vehicle) {
    bench.config.vehicle = vehicle;
    bench.config.source = "chaser";
  }

  void open() { feed.emplace(bench.context, *bench.config.vehicle); }

  // The pose that source `s` measures, moved by `error` along the vehicle's x.
  template <class Estimate>
  Estimate measured(std::size_t s, double error_m) {
    const SourceMounting& mounting = vehicle_.sources[s].mounting;
    VehicleFromTarget moved = truth();
    moved.t.x() += error_m;
    SensorFromFeature pose = mounting.vehicle_from_sensor().inverse() * moved * *mounting.target_from_feature();
    Vector6 noise;
    for (int i = 0; i < 6; ++i) noise[i] = (i < 3 ? kSigma_rad : kSigma_m) * normal_(random_);
    pose = pose.moved_by(noise);
    Estimate out;
    out.pose.R = pose.R;
    out.pose.t = pose.t;
    out.covariance.setZero();
    for (int i = 0; i < 6; ++i) out.covariance(i, i) = (i < 3 ? kSigma_rad * kSigma_rad : kSigma_m * kSigma_m);
    return out;
  }

  template <class Report>
  void send(Report report, const std::string& source, std::int64_t age_ns = 0) {
    report.utc_ns = bench.clock.utc_ns() - age_ns;
    report.source = source;
    if (report.target.empty()) report.target = "client";
    gate.publish(report);
    settle();
  }
  CycleReport lighthouse(double error_m = 0.0) {
    CycleReport report;
    report.sensor = "0A1B2C3D";
    report.pose = measured<LighthousePoseEstimate>(0, error_m);
    return report;
  }
  TofReport tof(double error_m = 0.0) {
    TofReport report;
    report.pose = measured<TofPoseEstimate>(1, error_m);
    return report;
  }
  StereoReport ring2(double error_m = 0.0) {
    StereoReport report(measured<Ring2PoseEstimate>(2, error_m));
    report.flags = "no_connector";
    return report;
  }

  // All jobs done.
  void settle() {
    if (!feed) return;
    while (!feed->finished()) bench.loop.turn(20);
  }

  // 10 steps of 20 ms for each tenth of a second: lighthouse at 50 Hz, cameras at 10 Hz and 40 ms late.
  void measure(int steps, double tof_error_m = 0.0, bool with_cameras = true) {
    for (int k = 0; k < steps; ++k) {
      bench.clock.advance(20 * kMs);
      send(lighthouse(), "lighthouse/chaser");
      if (!with_cameras || k % 5 != 0) continue;
      send(tof(tof_error_m), "tof/helios", 40 * kMs);
      send(ring2(), "ring2/bow", 45 * kMs);
    }
  }
  void look(std::int64_t after_ns) {
    bench.clock.advance(after_ns);
    feed->look();
    settle();
  }

  std::vector<target_state_t> states() const { return bench.sink.all<target_state_t>("PHAROS_TARGET_STATE"); }
  static double error_m(const target_state_t& state) { return (Vector3(state.position_m) - truth().t).norm(); }
  static double sigma_m(const target_state_t& s) {
    return std::sqrt(s.covariance[12 * 3 + 3] + s.covariance[12 * 4 + 4] + s.covariance[12 * 5 + 5]);
  }
  std::int64_t counter(const std::string& name) { return SourceBench::counter(*feed, name); }

  SourceBench bench;
  VehicleConfig vehicle_;
  std::int64_t not_finite_ = 0;
  PublishGate gate{bench.publisher, not_finite_};
  std::optional<FusionFeed> feed;
  std::mt19937_64 random_{20261123};
  std::normal_distribution<double> normal_;
};

}  // namespace pharos::host::test
