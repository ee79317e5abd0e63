// SPDX-License-Identifier: Apache-2.0
#include "pharos/pointing/orbit.hpp"

#include <gtest/gtest.h>

#include "orbit_sight.hpp"

namespace pharos::pointing {
namespace {

std::vector<Observation> pass_of(const OrbitSight& truth, bool with_range) {
  std::vector<Observation> observations;
  for (int k = 0; k < 100; ++k)
    observations.push_back(truth.observation(truth.culmination_s - 100.0 + 2.0 * k, with_range));
  return observations;
}

TEST(FindOrbit, FindsPlaneAndRadiusWithRangesAndWithout) {
  for (const double altitude_m : {300e3, 500e3, 1500e3, 20'200e3}) {
    OrbitSight truth;
    truth.altitude_m = altitude_m;
    for (const bool with_range : {true, false}) {
      const auto orbit = find_orbit(pass_of(truth, with_range), truth.station, truth.culmination_s);
      ASSERT_TRUE(orbit.ok()) << altitude_m << with_range;
      EXPECT_EQ(orbit->from_ranges, with_range);
      EXPECT_NEAR(orbit->radius_m, truth.radius_m(), with_range ? 1.0 : 10.0);
      EXPECT_LT((orbit->normal_inertial - truth.normal_inertial()).norm(), 1e-6);
      const Observation now = truth.observation(truth.culmination_s + 30.0, with_range);
      const Matrix3 R = inertial_to_orbital(*orbit, now, truth.station, truth.culmination_s);
      EXPECT_LT((R - truth.orbital(now.time_s)).norm(), 1e-5);
      EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-12);
    }
  }
}

TEST(FindOrbit, RefusesWhatFliesNoOrbit) {
  const OrbitSight truth;
  std::vector<Observation> observations = pass_of(truth, false);
  for (Observation& observation : observations) observation.time_s *= 0.05;  // a meteor
  EXPECT_EQ(find_orbit(observations, truth.station, 0.0).error(), OrbitFailure::kNotAnOrbit);
  std::vector<Observation> near = pass_of(truth, true);
  for (Observation& observation : near) observation.range_m = 100.0;
  EXPECT_FALSE(find_orbit(near, truth.station, truth.culmination_s).ok());
  near.resize(2);
  EXPECT_EQ(find_orbit(near, truth.station, truth.culmination_s).error(), OrbitFailure::kTooShort);
}

}  // namespace
}  // namespace pharos::pointing
