// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/edge_profile.hpp"

#include <gtest/gtest.h>

namespace pharos::tof {
namespace {

constexpr double kStep = 1e-7;

TEST(EdgeProfile, IsOneInsideAHalfAtTheEdgeAndNothingOutside) {
  const EdgeProfile profile{0.04, 0.004, 0.0};
  EXPECT_DOUBLE_EQ(profile.at(0.0, 0.0).value, 1.0);
  EXPECT_NEAR(profile.at(0.04, 0.0).value, 0.5, 1e-12);
  EXPECT_NEAR(profile.at(-0.04, 0.0).value, 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(profile.at(0.06, 0.0).value, 0.0);
}

TEST(EdgeProfile, AWallInSightFallsToNothingAtItsFoot) {
  for (const double sign : {1.0, -1.0}) {
    const EdgeProfile profile{0.04, 0.001, sign * 0.03};
    EXPECT_NEAR(profile.at(sign * 0.055, 0.6).value, 0.3, 1e-9);
    EXPECT_NEAR(profile.at(sign * 0.071, 0.6).value, 0.0, 1e-12);
    EXPECT_NEAR(profile.at(-sign * 0.05, 0.6).value, 0.0, 1e-12);
  }
}

TEST(EdgeProfile, DerivativesAreThoseOfCentralDifferences) {
  for (const double foot : {0.0, 0.02, -0.02}) {
    for (double place = -0.0597; place < 0.06; place += 0.0031) {
      const auto value = [&](double half, double blur, double at, double wall) {
        return EdgeProfile{half, blur, foot}.at(at, wall).value;
      };
      const EdgeProfile::Value exact = EdgeProfile{0.04, 0.004, foot}.at(place, 0.3);
      const auto slope = [](double after, double before) { return (after - before) / (2.0 * kStep); };
      EXPECT_NEAR(exact.by_place, slope(value(0.04, 0.004, place + kStep, 0.3), value(0.04, 0.004, place - kStep, 0.3)),
                  1e-2);
      EXPECT_NEAR(exact.by_half, slope(value(0.04 + kStep, 0.004, place, 0.3), value(0.04 - kStep, 0.004, place, 0.3)),
                  1e-2);
      EXPECT_NEAR(exact.by_wall, slope(value(0.04, 0.004, place, 0.3 + kStep), value(0.04, 0.004, place, 0.3 - kStep)),
                  1e-6);
      EXPECT_NEAR(exact.by_blur,
                  0.004 * slope(value(0.04, 0.004 + kStep, place, 0.3), value(0.04, 0.004 - kStep, place, 0.3)), 1e-4);
    }
  }
}

}  // namespace
}  // namespace pharos::tof
