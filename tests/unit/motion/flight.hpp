// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "pharos/base/ticks.hpp"
#include "pharos/base/units.hpp"
#include "pharos/lighthouse/decoder.hpp"
#include "pharos/motion/motion_tracker.hpp"
#include "tools/evaluation/problems/pnp_problems.hpp"
#include "tools/sim/lighthouse_simulator.hpp"

namespace pharos::test {

/// One ideal station and the paper's target, with the paper's noise: the base scenario of a flight.
inline sim::LighthouseScenario flight_scenario(double duration_s) {
  sim::LighthouseScenario scenario;
  scenario.duration_s = duration_s;
  scenario.target = frustum_target();
  scenario.noise.narrow_sigma_arcsec = 0.0;
  scenario.stations.emplace_back();
  return scenario;
}

inline sim::LighthouseScenario manoeuvre(double duration_s, double speed_m_s, double rate_deg_s, std::uint64_t seed) {
  sim::LighthouseScenario scenario = flight_scenario(duration_s);
  sim::ManoeuvreLimits limits;
  limits.speed_m_s = speed_m_s;
  limits.rate_deg_s = rate_deg_s;
  scenario.trajectory = sim::make_random_manoeuvre(limits, duration_s, sim::RandomStream(seed, "flight"));
  return scenario;
}

/// A random stationary pose in which at least `lit` sensors are visible.
inline sim::LighthouseScenario still(double duration_s, double range_m, std::uint64_t seed, int lit = 6) {
  sim::LighthouseScenario scenario = flight_scenario(duration_s);
  sim::RandomStationaryPoses rest;
  rest.min_range_m = rest.max_range_m = range_m;
  rest.min_lit = lit;
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      sim::random_stationary_poses(rest, scenario.target, scenario.light.max_incidence_deg,
                                   sim::RandomStream(seed, "still")),
      duration_s, 0.0);
  return scenario;
}

/// One result with the truth at its time.
struct FlightSample {
  double time_s = 0.0;
  const track::EpochResult* result = nullptr;
  LighthouseFromBody truth;

  double rotation_deg() const { return rotation_angle_between(result->pose->pose.R, truth.R) * kDegPerRad; }
  double position_mm() const { return (result->pose->pose.t - truth.t).norm() * kMmPerM; }
  double nees() const { return nees_of(truth, result->pose.value()); }
};

/// Options of a flight: simulated flashes are independent, so there is nothing to smooth.
inline motion::MotionOptions flight_options() {
  motion::MotionOptions options;
  options.smooth_flashes = false;
  return options;
}

/// Sets a tracker's calibrations before a flight.
using Prepare = std::function<void(motion::MotionTracker&, const sim::LighthouseSimulator&)>;

/// Every station is ideal.
inline void tell_ideal_stations(motion::MotionTracker& tracker, const sim::LighthouseSimulator& simulator) {
  const auto stations = static_cast<std::uint8_t>(simulator.stations().size());
  for (std::uint8_t station = 0; station < stations; ++station) tracker.set_calibration(station, {});
}

/// The calibrations that the stations send over OOTX.
inline void tell_announced(motion::MotionTracker& tracker, const sim::LighthouseSimulator& simulator) {
  const auto stations = static_cast<std::uint8_t>(simulator.stations().size());
  for (std::uint8_t station = 0; station < stations; ++station) {
    lighthouse::StationCalibration calibration;
    for (std::size_t k = 0; k < kAxes; ++k) {
      const sim::SheetErrors& sent = simulator.stations()[station].announced.rotor[k];
      calibration.rotor[k] = {sent.phase_rad, sent.tilt_rad, sent.curve_rad, sent.gibbous_phase_rad,
                              sent.gibbous_magnitude_rad};
    }
    tracker.set_calibration(station, calibration);
  }
}

/// Simulates a scenario, with ideal stations unless `prepare` sets others, with decoder and tracker; a result's truth
/// is in its station's frame. `corrupt` may change each sweep before the tracker sees it.
inline void fly(
    const sim::LighthouseScenario& scenario, std::uint64_t seed, const std::function<void(const FlightSample&)>& take,
    const std::function<void(lighthouse::Sweep&)>& corrupt = [](lighthouse::Sweep&) {},
    const motion::MotionOptions& options = flight_options(), const Prepare& prepare = tell_ideal_stations) {
  sim::LighthouseSimulator simulator(scenario, seed);
  const auto decoder = std::make_unique<lighthouse::Decoder>();
  const auto tracker = std::make_unique<motion::MotionTracker>(scenario.target, options);
  prepare(*tracker, simulator);
  const auto give = [&] {
    while (decoder->take_ootx()) {
    }
    while (auto sweep = decoder->take_sweep()) {
      corrupt(*sweep);
      if (const auto result = tracker->push(*sweep)) {
        const double time_s = ticks_to_seconds(result->time_ticks);
        take({time_s, &*result, simulator.truth(result->station, time_s)});
      }
    }
  };
  while (const auto pulse = simulator.next()) {
    decoder->push(lighthouse::RawPulse{pulse->rise_ticks, pulse->fall_ticks, pulse->sensor});
    give();
  }
  decoder->flush();
  give();
}

/// Consistency and accuracy of many results.
struct FlightScore {
  int answers = 0, ambiguous = 0, refused = 0;
  double nees = 0.0, rotation_nees = 0.0, position_nees = 0.0, sigma_position_square = 0.0, rotation_square = 0.0,
         position_square = 0.0, rotation_max_deg = 0.0, position_max_mm = 0.0;

  void add(const FlightSample& answer) {
    if (!answer.result->pose) {
      ++refused;
      return;
    }
    if (answer.result->pose->ambiguous()) {
      ++ambiguous;
      return;
    }
    ++answers;
    nees += answer.nees();
    const LighthousePoseEstimate& estimate = answer.result->pose.value();
    const Vector6 error = pose_difference(answer.truth, estimate.pose);
    const Matrix3 rotation = estimate.covariance.topLeftCorner<3, 3>();
    const Matrix3 position = estimate.covariance.bottomRightCorner<3, 3>();
    rotation_nees += error.head<3>().dot(rotation.inverse() * error.head<3>());
    position_nees += error.tail<3>().dot(position.inverse() * error.tail<3>());
    sigma_position_square += position.trace();
    rotation_square += answer.rotation_deg() * answer.rotation_deg();
    position_square += answer.position_mm() * answer.position_mm();
    rotation_max_deg = std::max(rotation_max_deg, answer.rotation_deg());
    position_max_mm = std::max(position_max_mm, answer.position_mm());
  }
  double nees_per_freedom() const { return nees / (6.0 * answers); }
  double rotation_rms_deg() const { return std::sqrt(rotation_square / answers); }
  double position_rms_mm() const { return std::sqrt(position_square / answers); }
};

}  // namespace pharos::test
