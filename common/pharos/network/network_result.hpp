// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/geometry/pose.hpp"
#include "pharos/network/station.hpp"
#include "pharos/network/sweep.hpp"
#include "pharos/pose/solve.hpp"

namespace pharos::network {

/// Why a result is as it is; bits of NetworkResult::flags.
enum NetworkFlag : std::uint8_t {
  kFused = 1,            // light of several stations within the last tenth of a second
  kOutliers = 2,         // hits of this sweep were left out
  kStationExcluded = 4,  // a station contradicts the others and is not used
};

struct NetworkOptions {
  HitNoise noise{40e-6, 40e-6, 0.2e-3, 0.3e-3, 0.6e-3};
  double max_rotation_rad = 1.0;  // stated sigmas beyond which no pose is reported
  double max_position_m = 0.1;
};

/// The body after a sweep.
struct NetworkResult {
  double time_s = 0.0;       // of the sweep's last hit
  std::uint8_t station = 0;  // whose sweep, its place among the stations
  std::uint8_t plane = 0;
  Result<WorldFromBody, pose::Refusal> pose = pose::Refusal::kNone;
  Matrix6 covariance = Matrix6::Zero();  // world frame, stations' uncertainty included
  double residual_rms_rad = 0.0;         // of this sweep's hits
  int observations = 0;                  // of this sweep that were used
  bool ambiguous = false;
  WorldFromBody second;  // where ambiguous
  double delta_chi2 = 0.0;
  std::uint8_t flags = 0;
};

struct NetworkCounters {
  std::uint64_t sweeps = 0, hits = 0, hits_left_out = 0, sweeps_refused = 0, starts = 0, losses = 0, exclusions = 0,
                strays = 0, readmissions = 0, rate_resets = 0, hits_unknown = 0;
};

}  // namespace pharos::network
