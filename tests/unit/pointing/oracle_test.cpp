// SPDX-License-Identifier: Apache-2.0
// Earth-fixed directions and places beside GeographicLib's.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <random>
#include <vector>

#include "pharos/base/units.hpp"
#include "pharos/pointing/station.hpp"

namespace pharos::pointing {
namespace {

TEST(EarthFixed, DirectionsAndPlacesAreThoseOfAnIndependentLibrary) {
  const GeographicLib::Geocentric& earth = GeographicLib::Geocentric::WGS84();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> latitude(-90.0, 90.0), longitude(-180.0, 180.0), height(-400.0, 9000.0);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 2000; ++k) {
    const double b = latitude(random), l = longitude(random), h = height(random);
    double x = 0.0, y = 0.0, z = 0.0;
    std::vector<double> R(9);  // row by row: local east, north, up to geocentric
    earth.Forward(b, l, h, x, y, z, R);
    const Geodetic station{b * kRadPerDeg, l * kRadPerDeg, h};
    const Vector3 direction = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 theirs(R[0] * direction.x() + R[1] * direction.y() + R[2] * direction.z(),
                         R[3] * direction.x() + R[4] * direction.y() + R[5] * direction.z(),
                         R[6] * direction.x() + R[7] * direction.y() + R[8] * direction.z());
    const Vector3 ours = station_to_earth(station) * direction;
    EXPECT_LT(ours.cross(theirs).norm(), 1e-9) << "latitude " << b << " longitude " << l;
    EXPECT_GT(ours.dot(theirs), 0.0);
    EXPECT_LT((station_place_earth_m(station) - Vector3(x, y, z)).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace pharos::pointing
