// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/geometry/pose.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {

/// The truth's step; rates of sources divide it.
inline constexpr int kWorldRate_hz = 600;

using WorldSensorPose = Pose<frame::Camera, frame::Body>;

/// A source of poses.
struct MeasuredSource {
  std::string name;
  int rate_hz = 10;
  double delay_s = 0.0;
  // Noise of one pose, and the slow error: 1 sigma of each axis and its time constant. Noise is white, or of a source
  // that filters alike for noise_time_s (first-order Gauss-Markov).
  double noise_rad = 1e-3;
  double noise_m = 1e-3;
  double noise_time_s = 0.0;
  double bias_rad = 5e-4;
  double bias_m = 5e-4;
  double bias_time_constant_s = 60.0;
  Pose<frame::Vehicle, frame::Camera> T_vehicle_sensor;
  Pose<frame::Target, frame::Body> T_target_feature;
  bool no_roll = false;   // the rotation about the feature's z axis is not measured: it is drawn at random
  bool relative = false;  // the feature's frame is the sensor's at the first pose; the slow error is a random walk
  // Sees the target within these times.
  double from_s = 0.0;
  double until_s = 1e9;
};

enum class SourceFaultKind : std::uint8_t {
  kNone,
  kStep,
  kRamp,
  kFreeze,
  kWrongTime,
  kWrongScale,
  kMirrored,
  kWrongTarget,
  kOutliers,
};

struct SourceFault {
  SourceFaultKind kind = SourceFaultKind::kNone;
  std::size_t source = 0;
  double from_s = 0.0;
  double until_s = 1e9;
  double size = 10.0;  // in sigmas of the source's noise; of kWrongTime in 5 ms
};

struct WorldSettings {
  std::uint64_t seed = 1;
  double duration_s = 30.0;
  Vector3 position_m{0.1, -0.05, 2.5};
  Vector3 velocity_m_s{0.002, 0.001, -0.02};
  Vector3 rate_rad_s{0.002, 0.004, 0.017};
  double acceleration_density = 1e-6;          // (m/s^2)^2 s
  double angular_acceleration_density = 1e-8;  // (rad/s^2)^2 s
  std::vector<MeasuredSource> sources;
  SourceFault fault;
};

struct TruthState {
  double time_s = 0.0;
  Pose<frame::Vehicle, frame::Target> pose;
  Vector3 rate_rad_s = Vector3::Zero();
  Vector3 velocity_m_s = Vector3::Zero();
};

/// A pose as a source states it.
struct SimulatedPose {
  std::size_t source = 0;
  double time_s = 0.0;     // as stated; wrong where the fault says so
  double arrival_s = 0.0;  // when the fusion hears of it
  WorldSensorPose pose;
  double noise_rad = 0.0;
  double noise_m = 0.0;
  std::optional<Vector3> unmeasured_axis;  // in the sensor's frame
  bool faulty = false;
};

struct MeasuredWorld {
  std::vector<TruthState> truth;     // every 1 / kWorldRate_hz s from 0
  std::vector<SimulatedPose> poses;  // by arrival
};

MeasuredWorld simulate_world(const WorldSettings& settings);

}  // namespace pharos::sim
