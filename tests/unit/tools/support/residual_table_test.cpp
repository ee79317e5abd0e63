// SPDX-License-Identifier: Apache-2.0
#include "tools/support/residual_table.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "pharos/base/units.hpp"

namespace pharos::tools {
namespace {

TEST(RunningMoments, AgreeWithTheirDefinition) {
  RunningMoments moments;
  EXPECT_EQ(moments.deviation(), std::nullopt);
  // Far from zero: a simple sum of squares would lose every digit.
  for (const double value : {1e9 + 1.0, 1e9 + 2.0, 1e9 + 4.0}) moments.push(value);
  EXPECT_EQ(moments.count(), 3);
  EXPECT_DOUBLE_EQ(moments.mean(), 1e9 + 7.0 / 3.0);
  EXPECT_NEAR(*moments.deviation(), std::sqrt(7.0 / 3.0), 1e-6);
}

TEST(ResidualTable, ShowsEachSensorOfEachAxisAndStation) {
  const auto bearing = [](std::uint8_t sensor, bool used, double residual_arcsec) {
    track::TrackedBearing made;
    made.raw.sensor = sensor;
    made.axis = Axis::kY;
    made.used = used;
    made.residual_rad = residual_arcsec * kRadPerArcsec;
    return made;
  };
  ResidualTable table;
  table.push(1, bearing(3, true, 10.0));
  table.push(1, bearing(5, false, 900.0));
  table.push(1, bearing(3, true, 14.0));
  table.push(1, bearing(5, false, 900.0));
  const std::string path = ::testing::TempDir() + "pharos_residual_table.csv";
  table.write({false, path});
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "station,axis,sensor,used,left_out,mean_arcsec,sd_arcsec,rms_arcsec");
  std::getline(file, line);
  double mean = 0.0, deviation = 0.0, rms = 0.0;
  ASSERT_EQ(std::sscanf(line.c_str(), "1,y,3,2,0,%lf,%lf,%lf", &mean, &deviation, &rms), 3) << line;
  EXPECT_NEAR(mean, 12.0, 1e-9);
  EXPECT_NEAR(deviation, std::sqrt(8.0), 1e-9);
  EXPECT_NEAR(rms, std::sqrt(148.0), 1e-9);
  std::getline(file, line);
  EXPECT_EQ(line, "1,y,5,0,2,,,");
  EXPECT_FALSE(std::getline(file, line));
  std::remove(path.c_str());
}

}  // namespace
}  // namespace pharos::tools
