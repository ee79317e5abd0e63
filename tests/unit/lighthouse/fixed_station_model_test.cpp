// SPDX-License-Identifier: Apache-2.0
// The inverse model in integers compared with that in double.
#include "pharos/lighthouse/fixed_station_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pharos/base/units.hpp"

namespace pharos::lighthouse {
namespace {

class FixedStationModelTest : public ::testing::TestWithParam<ModelForm> {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  StationCalibration station(double scale) {
    StationCalibration s;
    for (RotorCalibration& rotor : s.rotor) {
      rotor = {uniform(-0.06, 0.06) * scale, uniform(-0.01, 0.01) * scale, uniform(-0.0083, 0.0083) * scale,
               uniform(-kPi, kPi), uniform(-0.02, 0.02) * scale};
    }
    return s;
  }
  void expect_equal(const StationCalibration& s, double half_field_rad, double tolerance_rad) {
    FixedStationModel fixed(s, GetParam());
    for (int k = 0; k < 200; ++k) {
      const ThetaPair raw{kPi / 2 + uniform(-half_field_rad, half_field_rad),
                          kPi / 2 + uniform(-half_field_rad, half_field_rad)};
      const auto expected = ideal_from_raw(s, GetParam(), raw);
      const auto answer = fixed.ideal_from_raw(raw);
      ASSERT_EQ(answer.has_value(), expected.has_value());
      if (!expected) continue;
      ASSERT_NEAR(answer->x_rad, expected->x_rad, tolerance_rad);
      ASSERT_NEAR(answer->y_rad, expected->y_rad, tolerance_rad);
    }
  }
  std::mt19937_64 engine_{7};
};

TEST_P(FixedStationModelTest, EqualsTheModelInDoubleOverTheField) {
  for (int k = 0; k < 50; ++k) expect_equal(station(1.0), 65.0 * kRadPerDeg, 2e-8);
}

TEST_P(FixedStationModelTest, EqualsItForAnIdealStation) { expect_equal({}, 70.0 * kRadPerDeg, 4e-9); }

TEST_P(FixedStationModelTest, EqualsItWhereIntegersDoNotReach) {
  expect_equal(station(1.0), 89.0 * kRadPerDeg, 1e-7);
  expect_equal(station(20.0), 60.0 * kRadPerDeg, 1e-7);
  StationCalibration far = station(1.0);
  far.rotor[0].gibbous_phase_rad = 20.0;
  expect_equal(far, 60.0 * kRadPerDeg, 2e-8);
}

TEST_P(FixedStationModelTest, EqualsItForOneAxisWithTheAngleAcrossKnown) {
  for (const double half_field_rad : {65.0 * kRadPerDeg, 89.0 * kRadPerDeg}) {
    const StationCalibration s = station(1.0);
    const FixedStationModel fixed(s, GetParam());
    for (int k = 0; k < 400; ++k) {
      const Axis axis = k % 2 == 0 ? Axis::kX : Axis::kY;
      const double raw = kPi / 2 + uniform(-half_field_rad, half_field_rad);
      const double across = kPi / 2 + uniform(-half_field_rad, half_field_rad);
      const auto expected = ideal_from_raw(s, GetParam(), axis, raw, across);
      const auto answer = fixed.ideal_from_raw(axis, raw, across);
      ASSERT_EQ(answer.has_value(), expected.has_value());
      if (!expected) continue;
      ASSERT_NEAR(*answer, *expected, 2e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, FixedStationModelTest, ::testing::Values(ModelForm::kForm1, ModelForm::kForm2));

}  // namespace
}  // namespace pharos::lighthouse
