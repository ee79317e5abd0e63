// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "host/calibrate/lighthouse_calibration.hpp"
#include "pharos/base/units.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::calibrate::test {
namespace {

Session short_session(std::uint64_t seed) {
  Session session;
  session.seed = seed;
  session.poses = 16;
  session.rest_s = 1.1;
  return session;
}

TEST(LighthouseCalibration, FindsShapeAndRotorsWithinItsCovariance) {
  double squares = 0.0;
  int freedom = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    sim::LighthouseSimulator simulator(scenario_of(short_session(seed)), seed);
    const LighthouseCalibration calibration = calibrate_lighthouse(calibration_input(simulator, seed));
    EXPECT_TRUE(calibration.bundle.converged);
    EXPECT_TRUE(calibration.scale_measured);
    const Truth truth = compare(calibration, simulator);
    EXPECT_LT(truth.shape_rms_m, 0.1e-3) << "seed " << seed;
    squares += truth.nees * truth.freedom;
    freedom += truth.freedom;
    for (const SensorFit& fit : calibration.fits) {
      if (fit.intervals < 4) continue;
      EXPECT_LT(fit.after_rad, 0.1 * fit.before_rad) << int{fit.sensor};
    }
  }
  // Four sigma of chi-squared around 1; the simulator's gibbous phases have smaller errors than their prior, which
  // lowers it a little.
  EXPECT_GT(squares / freedom, 0.6);
  EXPECT_LT(squares / freedom, 1.4);
}

TEST(LighthouseCalibration, TiesTwoStationsTogether) {
  Session session = short_session(2);
  session.stations = 2;
  sim::LighthouseSimulator simulator(scenario_of(session), session.seed);
  const LighthouseCalibration calibration = calibrate_lighthouse(calibration_input(simulator, session.seed));
  const Unknowns& unknowns = calibration.bundle.unknowns;
  ASSERT_EQ(unknowns.station.size(), 2u);
  ASSERT_TRUE(unknowns.T_reference_station[1].has_value());
  const std::size_t reference = unknowns.station[0].id == simulator.stations()[0].announced.id ? 0 : 1;
  const auto truth = simulator.stations()[reference].pose.inverse() * simulator.stations()[1 - reference].pose;
  const Vector6 error = pose_difference(*unknowns.T_reference_station[1], truth);
  const Matrix6 covariance = calibration.bundle.covariance.bottomRightCorner<6, 6>();
  // 99.9 % of chi-squared with six degrees of freedom.
  EXPECT_LT(mahalanobis_squared<6>(error, covariance), 22.5);
  EXPECT_LT(error.tail<3>().norm(), 3e-3);
  EXPECT_LT(compare(calibration, simulator).nees, 1.6);
}

// The same target in eight more poses, with the same station or another.
LighthouseCalibrationInput two_recordings(std::uint32_t second_id) {
  LighthouseCalibrationInput material;
  for (const std::uint64_t poses_seed : {1u, 2u}) {
    Session session = short_session(poses_seed);
    session.poses = 8;
    sim::LighthouseScenario scenario = scenario_of(session);
    if (poses_seed == 2) scenario.stations.front().id = second_id;
    sim::LighthouseSimulator simulator(scenario, 1);
    LighthouseCalibrationInput one = calibration_input(simulator, 1);
    material.target = one.target;
    material.lengths = one.lengths;
    material.recordings.push_back(std::move(one.recordings.front()));
  }
  return material;
}

TEST(LighthouseCalibration, JoinsRecordingsOfOneStation) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(1)), 1);
  const LighthouseCalibration calibration = calibrate_lighthouse(two_recordings(simulator.stations()[0].announced.id));
  EXPECT_EQ(calibration.poses, 16u);
  EXPECT_EQ(calibration.bundle.unknowns.station.size(), 1u);
  EXPECT_LT(compare(calibration, simulator).nees, 1.6);
}

TEST(LighthouseCalibration, LearnsOneTargetFromStationsNeverSeenTogether) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(1)), 1);
  const LighthouseCalibration calibration = calibrate_lighthouse(two_recordings(0xC33B4DE1u));
  const BundleResult& bundle = calibration.bundle;
  EXPECT_EQ(calibration.poses, 16u);
  ASSERT_EQ(bundle.unknowns.station.size(), 2u);
  EXPECT_FALSE(bundle.unknowns.T_reference_station[1].has_value());
  EXPECT_EQ(bundle.parameters.size(), 3u * 12u + 2u * 2u * kRotorParameters);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_LT(bundle.parameters[i].sigma, 0.1e-3) << bundle.parameters[i].name;
}

TEST(LighthouseCalibration, ReportsThatAnglesAloneDoNotGiveTheScale) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(1)), 1);
  LighthouseCalibrationInput material = calibration_input(simulator, 1);
  const MeasuredLength length = material.lengths.front();
  material.lengths.clear();
  const BundleResult without = calibrate_lighthouse(material).bundle;
  EXPECT_GT(without.scale_sigma, 0.95 * without.scale_prior_sigma);
  material.lengths = {length};
  const BundleResult with = calibrate_lighthouse(material).bundle;
  EXPECT_LT(with.scale_sigma, 2.0 * length.sigma_m / length.length_m);
  EXPECT_NEAR((with.unknowns.target[4].position_m - with.unknowns.target[8].position_m).norm(), length.length_m,
              3.0 * length.sigma_m);
}

TEST(LighthouseCalibration, KeepsTheBodyFrameOnTheNominalSensors) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(3)), 3);
  const LighthouseCalibration calibration = calibrate_lighthouse(calibration_input(simulator, 3));
  Vector3 shift = Vector3::Zero();
  Vector3 turn = Vector3::Zero();
  for (std::size_t i = 0; i < simulator.nominal_target().size(); ++i) {
    const Vector3& nominal = simulator.nominal_target()[i].position_m;
    const Vector3 moved = calibration.bundle.unknowns.target[i].position_m - nominal;
    shift += moved;
    turn += nominal.cross(moved);
  }
  EXPECT_LT(shift.norm(), 1e-7);
  EXPECT_LT(turn.norm(), 1e-8);
}

TEST(LighthouseCalibration, LeavesASensorThatWasNeverHitAtItsPrior) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(1)), 1);
  LighthouseCalibrationInput material = calibration_input(simulator, 1);
  constexpr std::uint8_t kDead = 6;
  for (LoggedSweep& sweep : material.recordings.front().sweeps) {
    std::erase_if(sweep.hits, [](const LoggedHit& hit) { return hit.sensor == kDead; });
  }
  const BundleResult bundle = calibrate_lighthouse(material).bundle;
  EXPECT_LT((bundle.unknowns.target[kDead].position_m - material.target[kDead].position_m).norm(), 1e-9);
  for (std::size_t i = 3 * kDead; i < 3 * kDead + 3; ++i) {
    EXPECT_NEAR(bundle.parameters[i].sigma, material.sigmas.sensor_position_m, 1e-9) << bundle.parameters[i].name;
  }
  EXPECT_LT(bundle.parameters[0].sigma, 0.3 * bundle.parameters[0].prior_sigma);
}

TEST(LighthouseCalibration, IsNotMisledByReflections) {
  sim::LighthouseScenario scenario = scenario_of(short_session(1));
  sim::ReflectionScenario reflection;
  reflection.sensors = {0, 3, 5};
  scenario.faults.reflections.push_back(reflection);
  sim::LighthouseSimulator simulator(scenario, 1);
  const LighthouseCalibration calibration = calibrate_lighthouse(calibration_input(simulator, 1));
  const Truth truth = compare(calibration, simulator);
  EXPECT_LT(truth.shape_rms_m, 0.1e-3);
  EXPECT_LT(truth.nees, 1.8);
}

TEST(LighthouseCalibration, CountsWhatTheModelLeavesIntoItsCovariance) {
  sim::LighthouseSimulator simulator(scenario_of(short_session(1)), 1);
  LighthouseCalibrationInput material = calibration_input(simulator, 1);
  const LighthouseCalibration unperturbed = calibrate_lighthouse(material);
  // Errors that no parameter explains: random for every sensor in every second.
  sim::RandomStream random(1, "unmodelled");
  std::map<std::pair<std::int64_t, int>, double> error_rad;
  for (LoggedSweep& sweep : material.recordings.front().sweeps) {
    for (LoggedHit& hit : sweep.hits) {
      const std::int64_t pose =
          (sweep.flash_ticks - material.recordings.front().sweeps.front().flash_ticks) / 65'000'000;
      const auto [place, fresh] = error_rad.try_emplace({pose, 2 * hit.sensor + index_of(sweep.axis)}, 0.0);
      if (fresh) place->second = 5.0 * kRadPerArcsec * random.normal();
      hit.raw_rad += place->second;
    }
  }
  const LighthouseCalibration real = calibrate_lighthouse(material);
  EXPECT_LT(unperturbed.unmodelled_rad * kArcsecPerRad, 0.5);
  EXPECT_NEAR(real.unmodelled_rad * kArcsecPerRad, 5.0, 1.0);
  EXPECT_GT(real.bundle.parameters[0].sigma, 3.0 * unperturbed.bundle.parameters[0].sigma);
  EXPECT_LT(compare(real, simulator).nees, 1.6);
}

}  // namespace
}  // namespace pharos::calibrate::test
