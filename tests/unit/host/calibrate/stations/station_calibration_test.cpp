// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/station_calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/error_of.hpp"
#include "tests/unit/host/calibrate/stations/simulated_room.hpp"

namespace pharos::calibrate {
namespace {

using network::Generation;

constexpr double kRecorded_s = 10.0;

// What a user has: phases as sent, off by 0.3 mrad, and poses from elsewhere; the first station's is the gauge.
StationCalibrationInput input_of(const SimulatedRoom& room) {
  StationCalibrationInput input;
  input.log = room.record(kRecorded_s, 1.0, 7);
  input.target = room.target;
  input.stations = room.truth;
  for (network::Station& station : input.stations) {
    station.plane[0].phase_rad -= 0.3e-3;
    station.plane[1].phase_rad += 0.3e-3;
  }
  Vector6 moved;
  moved << 0.02, -0.015, 0.01, 0.02, -0.02, 0.015;
  input.stations[1].T_world_station = input.stations[1].T_world_station->moved_by(moved);
  return input;
}

double sigma_of(const StationCalibration& calibration, const std::string& name) {
  for (const StationParameter& p : calibration.parameters) {
    if (p.name == name) return p.sigma;
  }
  ADD_FAILURE() << "no parameter " << name;
  return 0.0;
}

double scale_error(const SimulatedRoom& room, const StationCalibration& found) {
  const auto baseline_m = [](const network::Stations& s) {
    return (s[1].T_world_station->t - s[0].T_world_station->t).norm();
  };
  return baseline_m(found.stations) / baseline_m(room.truth) - 1.0;
}

void expect_truth(const SimulatedRoom& room, const StationCalibration& found) {
  const Vector6 error = pose_difference(*found.stations[1].T_world_station, *room.truth[1].T_world_station);
  constexpr std::array<const char*, 6> kNames = {
      "rotation_x_rad", "rotation_y_rad", "rotation_z_rad", "x_m", "y_m", "z_m"};
  for (std::size_t k = 0; k < 6; ++k) {
    const double sigma = sigma_of(found, std::string("station 1 ") + kNames[k]);
    EXPECT_GT(sigma, 0.0) << kNames[k];
    EXPECT_LT(std::abs(error[static_cast<Eigen::Index>(k)]), 3.0 * sigma) << kNames[k];
  }
  EXPECT_LT(error.tail<3>().norm(), 0.02);
  EXPECT_LT(error.head<3>().norm(), 0.004);
  EXPECT_LT(std::abs(scale_error(room, found)), 3.0 * found.scale_sigma);
  EXPECT_LT(found.scale_sigma, 0.01);
  EXPECT_TRUE(found.converged);
  for (const auto& fits : found.fits) {
    for (const PlaneFit& fit : fits) EXPECT_LT(fit.mean_rad, 60e-6);
  }
}

class CalibratesARoom : public testing::TestWithParam<Generation> {};

TEST_P(CalibratesARoom, FindsAStationThatWasGivenWronglyWithinItsSigmas) {
  const SimulatedRoom room = simulated_room(GetParam());
  const StationCalibration found = calibrate_stations(input_of(room));
  expect_truth(room, found);
  EXPECT_FALSE(found.from_scratch);
}

TEST_P(CalibratesARoom, FindsStationsOfUnknownPoseFromTheRecordingAlone) {
  const SimulatedRoom room = simulated_room(GetParam());
  StationCalibrationInput input = input_of(room);
  input.stations[1].T_world_station.reset();
  const StationCalibration found = calibrate_stations(input);
  expect_truth(room, found);
  EXPECT_TRUE(found.from_scratch);
}

INSTANTIATE_TEST_SUITE_P(Generations, CalibratesARoom,
                         testing::Values(Generation::kLighthouse1, Generation::kLighthouse2));

// A target that looks 1 % larger at 45 deg than it is, along where the light comes from: rooms came out 0.8 % too
// small.
TEST_P(CalibratesARoom, BelievesLightFromAsideLess) {
  SimulatedRoom room = simulated_room(GetParam());
  room.stretch_from_aside = 0.01;
  const StationCalibration found = calibrate_stations(input_of(room));
  EXPECT_LT(std::abs(scale_error(room, found)), 0.005);
}

// What no field describes pulls the fields from what the stations send, alike in all of a recording: how far tells how
// wrong the geometry may be.
TEST(StationCalibration, StatesMoreWhereTheFieldsDepartFromWhatStationsSend) {
  const SimulatedRoom room = simulated_room(Generation::kLighthouse2);
  StationCalibrationInput input = input_of(room);
  const StationCalibration usual = calibrate_stations(input);
  for (network::Station& station : input.stations) {
    station.plane[0].tilt_rad += 3e-3;
    station.plane[1].gibbous_magnitude_rad += 3e-3;
  }
  const StationCalibration departed = calibrate_stations(input);
  for (std::size_t s = 0; s < 2; ++s) {
    EXPECT_GT(departed.stations[s].sigmas->plane_rad, 2.0 * usual.stations[s].sigmas->plane_rad) << s;
  }
  EXPECT_GT(sigma_of(departed, "station 1 rotation_z_rad"), 2.0 * sigma_of(usual, "station 1 rotation_z_rad"));
}

TEST(StationCalibration, TurnsTheWorldUpByTheAccelerations) {
  const SimulatedRoom room = simulated_room(Generation::kLighthouse1);
  StationCalibrationInput input = input_of(room);
  // A world that lies askew.
  const Matrix3 askew = rotation_exp({0.2, -0.1, 0.0});
  const Vector3 centre = input.stations[0].T_world_station->t;
  for (network::Station& s : input.stations) {
    s.T_world_station =
        network::WorldFromStation{askew * s.T_world_station->R, centre + askew * (s.T_world_station->t - centre)};
  }
  for (double t = 0.0; t < kRecorded_s; t += 0.01) {
    constexpr double kStep_s = 1e-3;
    const auto at = [&](double time_s) { return SimulatedRoom::body_at(time_s, 1.0); };
    const Vector3 a = (at(t + kStep_s).t - 2.0 * at(t).t + at(t - kStep_s).t) / (kStep_s * kStep_s);
    input.accelerations.push_back({t, at(t).R.transpose() * (a + 9.81 * Vector3::UnitZ())});
  }
  const StationCalibration found = calibrate_stations(input);
  ASSERT_TRUE(found.up_sigma_rad);
  // The true room's up in the found world.
  const Vector3 up =
      found.stations[0].T_world_station->R * room.truth[0].T_world_station->R.transpose() * Vector3::UnitZ();
  EXPECT_LT(std::acos(std::min(1.0, up.z())), 0.01);
}

TEST(StationCalibration, RefusesInOneLineWhatCannotBeCalibrated) {
  const SimulatedRoom room = simulated_room(Generation::kLighthouse2);
  const auto error = [&](const auto& change) {
    StationCalibrationInput input = input_of(room);
    change(input);
    return test::error_of([&] { calibrate_stations(input); });
  };
  const auto only_first = [](StationCalibrationInput& input) {
    std::erase_if(input.log.hits, [](const NetworkHit& hit) { return hit.station != 0; });
  };
  EXPECT_THAT(error(only_first), testing::HasSubstr("at least two are needed"));
  EXPECT_THAT(error([](auto& input) { input.stations.resize(1); }), testing::HasSubstr("at least two are needed"));
  EXPECT_THAT(error([](auto& input) {
                for (NetworkHit& hit : input.log.hits) hit.hit.sensor = 20;
              }),
              testing::HasSubstr("at least two are needed"));
  EXPECT_THAT(error([&](auto& input) { input.log = room.record(kRecorded_s, 0.0, 7); }),
              testing::HasSubstr("hardly moved"));
  EXPECT_THAT(error([](auto& input) { input.log.hits.resize(1000); }), testing::HasSubstr("carry the target"));
  // Two stations that never see it at once.
  EXPECT_THAT(error([](auto& input) {
                input.stations[1].T_world_station.reset();
                std::erase_if(input.log.hits, [](const NetworkHit& hit) {
                  return (std::fmod(hit.hit.time_s, 2.0) < 1.0) != (hit.station == 0);
                });
              }),
              testing::HasSubstr("where two stations see it"));
}

}  // namespace
}  // namespace pharos::calibrate
