// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/laser_sheet.hpp"

#include <gtest/gtest.h>

#include "tests/unit/sim/simulated_light.hpp"

namespace pharos::sim {
namespace {

double turn_at_hit(const LaserSheet& sheet, const Vector3& p_L) {
  double turn = sheet.ideal_turn(p_L);
  for (int step = 0; step < 50; ++step) turn += sheet.lead(turn, p_L);
  return turn;
}

Vector3 random_point(RandomStream& random) {
  const double z = random.uniform(0.5, 8.0);
  return {z * random.uniform(-1.7, 1.7), z * random.uniform(-1.7, 1.7), z};
}

SheetErrors random_errors(RandomStream& random) {
  return {random.uniform(-0.07, 0.07), random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01),
          random.uniform(-3.1, 3.1), random.uniform(-0.021, 0.021)};
}

TEST(LaserSheet, WithoutErrorsHitsStraightAheadAtAQuarterTurn) {
  for (const Rotor rotor : {Rotor::kX, Rotor::kY}) {
    const LaserSheet sheet(rotor, SheetForm::kForm1, {});
    EXPECT_NEAR(turn_at_hit(sheet, {0.0, 0.0, 3.0}), kPiTest / 2, 1e-12);
  }
}

TEST(LaserSheet, WithoutErrorsMeasuresThePapersAngles) {
  const Vector3 p(0.4, -0.7, 2.0);
  EXPECT_NEAR(1.0 / std::tan(turn_at_hit({Rotor::kX, SheetForm::kForm1, {}}, p)), 0.4 / 2.0, 1e-12);
  EXPECT_NEAR(1.0 / std::tan(turn_at_hit({Rotor::kY, SheetForm::kForm1, {}}, p)), -0.7 / 2.0, 1e-12);
}

TEST(LaserSheet, MeetsPointsWhereThePublishedEquationsSay) {
  RandomStream random(5, "laser sheet test");
  for (int trial = 0; trial < 5000; ++trial) {
    const SheetErrors errors = random_errors(random);
    const Vector3 p = random_point(random);
    for (const bool axis_y : {false, true}) {
      const Rotor rotor = axis_y ? Rotor::kY : Rotor::kX;
      EXPECT_NEAR(turn_at_hit({rotor, SheetForm::kForm1, errors}, p), published_theta_form1(axis_y, errors, p), 1e-7);
      EXPECT_NEAR(turn_at_hit({rotor, SheetForm::kForm2, errors}, p), published_theta_form2(axis_y, errors, p), 1e-7);
    }
  }
}

TEST(LaserSheet, FormsDifferInTheSignOfTheCurve) {
  const SheetErrors curved{0.0, 0.0, 0.005, 0.0, 0.0};
  const Vector3 high(0.0, -2.0, 2.0);  // 45 deg along the axis of rotor x
  const double square = (kPiTest / 4) * (kPiTest / 4);
  EXPECT_NEAR(turn_at_hit({Rotor::kX, SheetForm::kForm1, curved}, high), kPiTest / 2 + 0.005 * square, 1e-10);
  EXPECT_NEAR(turn_at_hit({Rotor::kX, SheetForm::kForm2, curved}, high), kPiTest / 2 - 0.005 * square, 1e-10);
}

}  // namespace
}  // namespace pharos::sim
