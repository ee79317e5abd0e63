// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "host/calibrate/stations/station_unknowns.hpp"

namespace pharos::calibrate {

/// A sweep of an adjustment: at most one hit a sensor, within one piece of motion.
struct UsedSweep {
  network::PlaneSweep sweep;
  std::size_t motion = 0;  // index of its spline
};

/// White jerk of the body, (rad/s^3)^2 s and (m/s^3)^2 s: only what makes a spline out of sparse light. That of
/// translation is a thousand times a hand's: where it counts, a smaller room is a smoother motion, and the scale
/// shrinks (by 15 % at a hand's own). That of rotation has no such preference.
struct JerkDensity {
  double rotation = 3e4;
  double translation = 1e6;
};

struct StationBundleOptions {
  double sensor_sigma_m = 0.2e-3;  // where light meets each sensor, 1 sigma of each coordinate
  JerkDensity jerk;
  int max_steps = 150;
};

/// Noise by station and plane.
using NetworkNoise = std::vector<std::array<PlaneNoise, network::kPlanes>>;

/// Residuals of one sweep after an adjustment, by hit, rad.
using SweepResiduals = std::vector<double>;

struct StationBundleResult {
  StationUnknowns unknowns;
  bool converged = false;
  std::vector<SweepResiduals> residuals;  // as the sweeps
  /// Covariance: for each station 6 of its pose (as Pose::moved_by; zero of the first, which is the gauge) and 7 of
  /// each plane's fields, then 3 a sensor. From the scatter of the pieces of motion, and not below what the noise
  /// makes: what a model leaves is alike within a piece and does not average out over its sweeps. Empty unless asked.
  Eigen::MatrixXd covariance;
};

/// Where a station's part begins in the covariance.
inline constexpr std::size_t kStationColumns = 6 + network::kPlanes * kPlaneFields;

/// Adjusts the poses of all stations but the first, all fields under their priors, the sensors under theirs, and the
/// motion, with Cauchy's loss on each sweep. `prior`: the fields before.
StationBundleResult adjust_stations(const StationUnknowns& start, const network::Stations& prior, const Target& nominal,
                                    const std::vector<UsedSweep>& sweeps, const NetworkNoise& noise,
                                    const StationBundleOptions& options, bool with_covariance);

/// Residuals (measured - model) of a sweep at given unknowns, rad.
SweepResiduals residuals_of(const network::PlaneSweep& sweep, const BodySpline& motion,
                            const StationUnknowns& unknowns);

}  // namespace pharos::calibrate
