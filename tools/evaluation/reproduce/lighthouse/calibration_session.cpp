// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/reproduce/lighthouse/calibration_session.hpp"

#include "host/calibrate/calibration_file.hpp"
#include "host/calibrate/lighthouse_calibration.hpp"

namespace pharos::tools {
namespace {

constexpr double kCarried_s = 0.2;  // without light, between stationary intervals
constexpr double kLengthSigma_m = 0.02e-3;
constexpr std::uint8_t kLengthFrom = 4, kLengthTo = 8;

sim::LighthouseScenario rests_of(const CalibrationSession& session, std::uint64_t seed) {
  sim::LighthouseScenario scenario = paper_scenario(session.poses * (session.rest_s + kCarried_s));
  scenario.errors = sim::ErrorScenario::workshop();
  scenario.stations.front().calibration.reset();
  sim::RandomStationaryPoses rest;
  rest.count = session.poses;
  rest.min_range_m = 1.0;
  rest.max_range_m = 3.0;
  rest.min_lit = 6;
  scenario.trajectory = std::make_shared<sim::StationaryTrajectory>(
      sim::random_stationary_poses(rest, scenario.target, scenario.light.max_incidence_deg,
                                   sim::RandomStream(seed, "calibration")),
      session.rest_s + kCarried_s, kCarried_s);
  return scenario;
}

lighthouse::StationCalibration announced(const sim::LighthouseSimulator& simulator) {
  lighthouse::StationCalibration station;
  station.id = simulator.stations()[0].announced.id;
  for (std::size_t k = 0; k < kAxes; ++k) {
    const sim::SheetErrors& e = simulator.stations()[0].announced.rotor[k];
    station.rotor[k] = {e.phase_rad, e.tilt_rad, e.curve_rad, e.gibbous_phase_rad, e.gibbous_magnitude_rad};
  }
  return station;
}

}  // namespace

RunAssumptions calibrate_for(const SimulatedRun& run, const CalibrationSession& session, std::uint64_t seed) {
  const SimulatedRun rests(rests_of(session, seed), seed);
  calibrate::LighthouseCalibrationInput material;
  material.target = rests.simulator().nominal_target();
  material.recordings.emplace_back();
  calibrate::RecordingLog& log = material.recordings.back();
  log.name = "simulated rests";
  for (const lighthouse::Sweep& sweep : rests.sweeps()) log.push(sweep);
  log.station[0] = announced(rests.simulator());
  sim::RandomStream random(seed, "measured length");
  const Target& built = rests.simulator().true_target();
  const double length_m =
      (find_sensor(built, kLengthFrom)->position_m - find_sensor(built, kLengthTo)->position_m).norm();
  material.lengths.push_back({kLengthFrom, kLengthTo, length_m + kLengthSigma_m * random.normal(), kLengthSigma_m});
  const Target nominal = material.target;
  const calibrate::LighthouseCalibration calibration = calibrate::calibrate_lighthouse(std::move(material));
  const auto file = calibrate::parse_calibration(calibrate::calibration_text(calibration, nominal), "simulated rests");
  RunAssumptions assumptions =
      run.with_assumptions(calibrate::calibrated_target(file, nominal), file.stations.front().calibration);
  assumptions.systematic = calibrate::systematic_errors(file);
  return assumptions;
}

}  // namespace pharos::tools
