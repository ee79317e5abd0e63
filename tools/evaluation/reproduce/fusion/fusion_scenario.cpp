// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/fusion/fusion_scenario.hpp"

#include <cmath>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

constexpr double kDeg = 1.0 / kDegPerRad;

Pose<frame::Vehicle, frame::Camera> mounted(const Vector3& rotation_deg, const Vector3& position_m) {
  return {rotation_exp(rotation_deg * kDeg), position_m};
}

sim::MeasuredSource source(const char* name, int rate_hz, double delay_s, double noise_deg, double noise_mm) {
  sim::MeasuredSource out;
  out.name = name;
  out.rate_hz = rate_hz;
  out.delay_s = delay_s;
  out.noise_rad = noise_deg * kDeg;
  out.noise_m = noise_mm / kMmPerM;
  return out;
}

}  // namespace

// Noise of single poses as the sources' own tables tell it at 2 m; slow errors as a mounting calibration leaves them
// (1 mm, 0.05 deg) and a little more for cameras.
sim::WorldSettings close_range_world(std::uint64_t seed) {
  sim::WorldSettings world;
  world.seed = seed;
  sim::MeasuredSource lighthouse = source("lighthouse", 60, 0.005, 0.1, 1.0);
  lighthouse.T_vehicle_sensor = mounted({1, -2, 0.5}, {0.3, 0.0, 0.1});
  lighthouse.T_target_feature = {rotation_exp(Vector3(0.02, 0.01, 1.5)), {0.2, -0.1, 0.05}};
  lighthouse.bias_rad = 0.04 * kDeg;
  lighthouse.bias_m = 0.8e-3;
  sim::MeasuredSource tof = source("tof", 10, 0.060, 0.2, 1.5);
  tof.T_vehicle_sensor = mounted({0, 3, 1}, {-0.2, 0.1, 0.0});
  tof.bias_rad = 0.05 * kDeg;
  tof.bias_m = 1e-3;
  sim::MeasuredSource ring2 = source("ring2", 10, 0.100, 0.2, 3.0);
  ring2.T_vehicle_sensor = mounted({-1, 0, 0}, {0.0, -0.2, 0.0});
  ring2.no_roll = true;
  ring2.bias_rad = 0.05 * kDeg;
  ring2.bias_m = 1.5e-3;
  sim::MeasuredSource slam = source("slam", 10, 0.120, 0.1, 3.0);
  slam.T_vehicle_sensor = ring2.T_vehicle_sensor;
  slam.relative = true;
  slam.bias_rad = 0.3 * kDeg;
  slam.bias_m = 5e-3;
  world.sources = {lighthouse, tof, ring2, slam};
  return world;
}

fusion::Settings settings_of(const sim::WorldSettings& world, double faults_per_hour) {
  fusion::Settings settings;
  settings.motion.acceleration_density = world.acceleration_density;
  settings.motion.angular_acceleration_density = world.angular_acceleration_density;
  settings.motion.gyroscopic_ratio = 0.0;  // this world's rates change by white noise alone
  for (const sim::MeasuredSource& from : world.sources) {
    fusion::SourceSettings to;
    to.T_vehicle_sensor = {from.T_vehicle_sensor.R, from.T_vehicle_sensor.t};
    if (!from.relative) to.T_target_feature = {from.T_target_feature.R, from.T_target_feature.t};
    to.relative = from.relative;
    to.bias_frame = from.relative ? fusion::BiasFrame::kFeature : fusion::BiasFrame::kSensor;
    Vector6 sigma;
    sigma << Vector3::Constant(from.bias_rad), Vector3::Constant(from.bias_m);
    to.bias_covariance = sigma.cwiseAbs2().asDiagonal();
    to.bias_time_constant_s = from.bias_time_constant_s;
    to.noise_time_s = from.noise_time_s;
    to.faults_per_hour.fill(faults_per_hour);
    settings.sources.push_back(to);
  }
  return settings;
}

fusion::Measurement measurement_of(const sim::SimulatedPose& pose) {
  fusion::Measurement m;
  m.time_ns = std::llround(pose.time_s * 1e9);
  m.source = static_cast<std::uint8_t>(pose.source);
  m.pose = {pose.pose.R, pose.pose.t};
  Vector6 sigma;
  sigma << Vector3::Constant(pose.noise_rad), Vector3::Constant(pose.noise_m);
  m.covariance = sigma.cwiseAbs2().asDiagonal();
  if (pose.unmeasured_axis) m.directions = fusion::Directions::without_rotation_about(*pose.unmeasured_axis);
  return m;
}

}  // namespace pharos::tools
