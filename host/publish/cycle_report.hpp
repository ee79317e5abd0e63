// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pharos/base/axis.hpp"
#include "pharos/base/result.hpp"
#include "pharos/geometry/pose_estimate.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::host {

/// One bearing of a cycle, with what the solver made of it.
struct ReportedBearing {
  std::uint8_t sensor = 0;
  Axis axis = Axis::kX;
  std::uint16_t width_ticks = 0;
  std::int64_t offset_ns = 0;  // middle of the pulse after the cycle's time
  double raw_theta_rad = 0.0;
  double ideal_theta_rad = 0.0;
  bool used = false;
  double residual_rad = 0.0;
};

/// One cycle of one station on one target, in this computer's time: what pose_t and bearings_t are made of.
struct CycleReport {
  std::int64_t utc_ns = 0;        // of the measurement
  std::int64_t utc_sigma_ns = 0;  // as the clock mapping states it
  std::int64_t latency_ns = 0;    // from the last light used to now
  std::int64_t sequence = 0;
  std::string source;
  std::string target;
  std::string station_id;      // eight hex digits, empty while unknown
  std::uint8_t station = 0;    // slot position
  std::uint8_t flags = 0;      // of track::EpochFlag
  bool clock_was_set = false;  // this computer's clock, a moment ago: utime may have gone backwards
  int observations = 0;
  Result<LighthousePoseEstimate, pose::Refusal> pose = pose::Refusal::kTooFewSensors;
  std::vector<ReportedBearing> bearings;
};

}  // namespace pharos::host
