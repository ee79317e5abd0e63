// SPDX-License-Identifier: Apache-2.0
// Ten typical calibration sessions, compared with the truth.
#include <gtest/gtest.h>

#include <cstdio>

#include "pharos/base/units.hpp"
#include "unit/host/calibrate/simulated_session.hpp"

namespace pharos::calibrate::test {
namespace {

// A rotor's phase counts as observable where its stated sigma is at most half of the required 20 arcsec.
constexpr double kAsked_rad = 20.0 * kRadPerArcsec;

TEST(CalibrationCampaign, ThirtyPosesOfTwoSecondsAndOneLength) {
  constexpr std::uint64_t kSessions = 10;
  double nees = 0.0;
  double nees_shape = 0.0;
  double nees_rotors = 0.0;
  std::printf("seed, shape rms mm, shape worst mm, phase worst arcsec, NEES shape, rotors, both\n");
  for (std::uint64_t seed = 1; seed <= kSessions; ++seed) {
    Session session;
    session.seed = seed;
    sim::LighthouseSimulator simulator(scenario_of(session), seed);
    const LighthouseCalibration calibration = calibrate_lighthouse(calibration_input(simulator, seed));
    const Truth truth = compare(calibration, simulator);
    std::printf("%2d, %.4f, %.4f, %.1f, %.2f, %.2f, %.2f\n", static_cast<int>(seed), truth.shape_rms_m * kMmPerM,
                truth.shape_worst_m * kMmPerM, truth.phase_worst_rad * kArcsecPerRad, truth.nees_shape,
                truth.nees_rotors, truth.nees);
    EXPECT_EQ(calibration.poses, 30u);
    EXPECT_LT(truth.shape_worst_m, 0.04e-3) << "seed " << seed;
    for (const Parameter& parameter : calibration.bundle.parameters) {
      if (!parameter.name.ends_with(" phase_rad")) continue;
      EXPECT_LT(parameter.sigma, 0.5 * kAsked_rad) << parameter.name;
    }
    EXPECT_LT(truth.phase_worst_rad, kAsked_rad) << "seed " << seed;
    nees += truth.nees / kSessions;
    nees_shape += truth.nees_shape / kSessions;
    nees_rotors += truth.nees_rotors / kSessions;
  }
  std::printf("mean NEES per degree of freedom: shape %.2f, rotors %.2f, both %.2f\n", nees_shape, nees_rotors, nees);
  // Four sigma of chi-squared: 300 degrees of freedom in shape, 200 in rotors (of whose ten parameters the simulator
  // draws the two gibbous phases with small errors).
  EXPECT_GT(nees_shape, 0.7);
  EXPECT_LT(nees_shape, 1.3);
  EXPECT_GT(nees_rotors, 0.6);
  EXPECT_LT(nees_rotors, 1.4);
  EXPECT_LT(nees, 1.3);
}

}  // namespace
}  // namespace pharos::calibrate::test
