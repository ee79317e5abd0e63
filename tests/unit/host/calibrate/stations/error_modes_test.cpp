// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/stations/error_modes.hpp"

#include <gtest/gtest.h>

#include "host/calibrate/stations/station_bundle.hpp"
#include "tests/unit/host/calibrate/stations/simulated_room.hpp"

namespace pharos::calibrate {
namespace {

using network::Generation;

constexpr auto kColumns = static_cast<Eigen::Index>(kStationColumns);

class ErrorModes : public testing::TestWithParam<Generation> {
 protected:
  ErrorModes() {
    const SimulatedRoom room = simulated_room(GetParam());
    at_.stations = room.truth;
    at_.target = room.target;
    for (double begin_s = 0.0; begin_s < 10.0; begin_s += 1.0) {
      at_.motion.emplace_back(begin_s, begin_s + 0.9, 0.04, [](double t) { return SimulatedRoom::body_at(t, 1.0); });
    }
    error_ = Eigen::VectorXd::Zero(2 * kColumns + 3 * static_cast<Eigen::Index>(room.target.size()));
  }
  const Vector3& place(std::size_t station) const { return at_.stations[station].T_world_station->t; }
  auto pose_error(std::size_t station) { return error_.segment<6>(kColumns * static_cast<Eigen::Index>(station)); }
  StationErrors errors() const { return station_errors(at_, error_ * error_.transpose()); }
  // Of both stations' parts.
  static double size_of(const StationErrors& errors, std::size_t mode) {
    return mode < errors.modes[0].size() ? std::hypot(errors.modes[0][mode].norm(), errors.modes[1][mode].norm()) : 0.0;
  }

  StationUnknowns at_;
  Eigen::VectorXd error_;
};

TEST_P(ErrorModes, AMotionOfTheWholeRoomIsNone) {
  const Vector3 turn(0.01, -0.02, 0.015), shift(0.03, 0.01, -0.02);
  for (std::size_t s = 0; s < 2; ++s) pose_error(s) << turn, turn.cross(place(s)) + shift;
  EXPECT_LT(size_of(errors(), 0), 1e-5);
}

TEST_P(ErrorModes, AWrongScaleStretchesTheRoom) {
  for (std::size_t s = 0; s < 2; ++s) pose_error(s) << Vector3::Zero(), 0.01 * place(s);
  const StationErrors found = errors();
  const Vector3 apart = found.modes[1][0].tail<3>() - found.modes[0][0].tail<3>();
  const Vector3 expected = 0.01 * (place(1) - place(0));
  EXPECT_NEAR(std::abs(apart.dot(expected)), expected.squaredNorm(), 1e-3 * expected.squaredNorm());
  EXPECT_LT(apart.cross(expected).norm(), 1e-3 * expected.squaredNorm());
  EXPECT_LT(found.modes[0][0].head<3>().norm() + found.modes[1][0].head<3>().norm(), 1e-5);
  EXPECT_LT(size_of(found, 1), 1e-6);
}

TEST_P(ErrorModes, APhaseOfBothPlanesIsATurnOfTheStation) {
  const Eigen::Index fields = kColumns + 6;
  error_[fields] = 1e-3;
  if (GetParam() == Generation::kLighthouse2) error_[fields + static_cast<Eigen::Index>(kPlaneFields)] = 1e-3;
  const StationErrors of_phase = errors();
  error_.setZero();
  // The station's y axis: both generations count the first angle about it.
  pose_error(1).head<3>() = 1e-3 * at_.stations[1].T_world_station->R.col(1);
  const StationErrors of_turn = errors();
  for (std::size_t s = 0; s < 2; ++s) {
    const Vector6 phase = of_phase.modes[s][0], turn = of_turn.modes[s][0];
    EXPECT_LT(std::min((phase - turn).norm(), (phase + turn).norm()), 0.2 * turn.norm()) << s;
  }
  for (const double left_rad : of_phase.left_rad[1]) EXPECT_LT(left_rad, 0.2e-3);
}

INSTANTIATE_TEST_SUITE_P(Generations, ErrorModes, testing::Values(Generation::kLighthouse1, Generation::kLighthouse2));

}  // namespace
}  // namespace pharos::calibrate
