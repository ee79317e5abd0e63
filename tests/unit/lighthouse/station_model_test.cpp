// SPDX-License-Identifier: Apache-2.0
#include "pharos/lighthouse/station_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "pharos/base/units.hpp"

namespace pharos::lighthouse {
namespace {

constexpr double kInverseTolerance_rad = 1e-7;  // the documented accuracy

// Ranges of real stations (phase .015-.062, |tilt| <= .0096, |curve| <= .0083, |gibmag| <= .0206 rad).
StationCalibration random_station(std::mt19937& random) {
  const auto within = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  StationCalibration station;
  for (RotorCalibration& rotor : station.rotor) {
    rotor = {within(0.015, 0.062), within(-0.0096, 0.0096), within(-0.0083, 0.0083), within(-kPi, kPi),
             within(-0.0206, 0.0206)};
  }
  return station;
}

Vector3 random_point(std::mt19937& random, double half_field_rad) {
  std::uniform_real_distribution<double> angle(-half_field_rad, half_field_rad);
  return Vector3(std::tan(angle(random)), std::tan(angle(random)), 1.0) * 3.0;
}

// The model as published, in the station's own frame: X right, Y up, optical axis along -Z.
double published_raw(const RotorCalibration& c, ModelForm form, Axis axis, const Vector3& p_lighthouse) {
  const double X = p_lighthouse.x();
  const double Y = -p_lighthouse.y();
  const double Zp = p_lighthouse.z();
  const double a = axis == Axis::kX ? X : Y;
  const double o = axis == Axis::kX ? Y : X;
  const double s = axis == Axis::kX ? -1 : 1;
  const double ax = s * std::atan2(a, Zp);
  const double ay = std::atan2(o, Zp);
  const double r = std::hypot(a, Zp);
  if (form == ModelForm::kForm1) {
    double g = ax + kPi / 2 - c.phase_rad - std::asin(c.tilt_rad * o / r);
    g -= c.gibbous_magnitude_rad * std::cos(c.gibbous_phase_rad + g);
    return (g + c.curve_rad * ay * ay - kPi / 2) + kPi / 2;
  }
  return ax -
         (std::asin(o * std::tan(c.tilt_rad) / r) + c.phase_rad -
          c.gibbous_magnitude_rad * std::sin(ax + c.gibbous_phase_rad) + c.curve_rad * ay * ay) +
         kPi / 2;
}

TEST(StationModel, StraightAheadIsAQuarterTurn) {
  const ThetaPair ideal = ideal_thetas({0, 0, 2});
  EXPECT_DOUBLE_EQ(ideal.x_rad, kPi / 2);
  EXPECT_DOUBLE_EQ(ideal.y_rad, kPi / 2);
}

TEST(StationModel, IdealThetasSatisfyThePapersEquationTwo) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = random_point(random, 1.4);
    const ThetaPair ideal = ideal_thetas(p);
    EXPECT_NEAR(1.0 / std::tan(ideal.x_rad), p.x() / p.z(), 1e-12 * (1 + std::abs(p.x() / p.z())));
    EXPECT_NEAR(1.0 / std::tan(ideal.y_rad), p.y() / p.z(), 1e-12 * (1 + std::abs(p.y() / p.z())));
    EXPECT_NEAR((direction_of(ideal) - p.normalized()).norm(), 0.0, 1e-12);
  }
}

TEST(StationModel, WithoutErrorsRawIsIdeal) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const Vector3 p = random_point(random, 1.2);
    for (const ModelForm form : {ModelForm::kForm1, ModelForm::kForm2}) {
      EXPECT_NEAR(raw_theta({}, form, Axis::kX, p), ideal_thetas(p).x_rad, 1e-12);
      EXPECT_NEAR(raw_theta({}, form, Axis::kY, p), ideal_thetas(p).y_rad, 1e-12);
    }
  }
}

TEST(StationModel, ForwardIsThePublishedModelInBothForms) {
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    const StationCalibration station = random_station(random);
    const Vector3 p = random_point(random, kPi / 3);
    for (const ModelForm form : {ModelForm::kForm1, ModelForm::kForm2}) {
      for (const Axis axis : {Axis::kX, Axis::kY}) {
        EXPECT_NEAR(raw_theta(station, form, axis, p), published_raw(station[axis], form, axis, p), 1e-12);
      }
    }
  }
}

TEST(StationModel, InverseUndoesForwardOverTheWholeField) {
  std::mt19937 random(4);
  for (int i = 0; i < 5000; ++i) {
    const StationCalibration station = random_station(random);
    const Vector3 p = random_point(random, kPi / 3);
    for (const ModelForm form : {ModelForm::kForm1, ModelForm::kForm2}) {
      const ThetaPair raw{raw_theta(station, form, Axis::kX, p), raw_theta(station, form, Axis::kY, p)};
      const auto ideal = ideal_from_raw(station, form, raw);
      ASSERT_TRUE(ideal);
      EXPECT_NEAR(ideal->x_rad, ideal_thetas(p).x_rad, kInverseTolerance_rad);
      EXPECT_NEAR(ideal->y_rad, ideal_thetas(p).y_rad, kInverseTolerance_rad);
      const auto single = ideal_from_raw(station, form, Axis::kX, raw.x_rad, ideal_thetas(p).y_rad);
      ASSERT_TRUE(single);
      EXPECT_NEAR(*single, ideal_thetas(p).x_rad, kInverseTolerance_rad);
    }
  }
}

TEST(StationModel, ASingleAxisIsInsensitiveToAPoorGuessOfTheOther) {
  std::mt19937 random(5);
  for (int i = 0; i < 500; ++i) {
    const StationCalibration station = random_station(random);
    const Vector3 p = random_point(random, 0.8);
    const double raw = raw_theta(station, ModelForm::kForm1, Axis::kY, p);
    const double guess_error_rad = 0.05;
    const auto ideal =
        ideal_from_raw(station, ModelForm::kForm1, Axis::kY, raw, ideal_thetas(p).x_rad + guess_error_rad);
    ASSERT_TRUE(ideal);
    EXPECT_NEAR(*ideal, ideal_thetas(p).y_rad, 0.04 * guess_error_rad);
  }
}

TEST(StationModel, RefusesWhatLiesNotAheadAndNeverInventsNumbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  StationCalibration absurd;
  absurd.rotor[0] = {0.0, 0.0, 1e6, 0.0, 0.0};
  absurd.rotor[1] = {0.0, 0.0, 1e6, 0.0, 0.0};
  EXPECT_FALSE(ideal_from_raw({}, ModelForm::kForm1, ThetaPair{0.0, 1.0}));
  EXPECT_FALSE(ideal_from_raw({}, ModelForm::kForm1, ThetaPair{1.0, kPi}));
  EXPECT_FALSE(ideal_from_raw({}, ModelForm::kForm1, ThetaPair{nan, 1.0}));
  EXPECT_FALSE(ideal_from_raw({}, ModelForm::kForm1, Axis::kX, 1.0, nan));
  EXPECT_FALSE(ideal_from_raw(absurd, ModelForm::kForm1, ThetaPair{1.0, 1.0}));
}

}  // namespace
}  // namespace pharos::lighthouse
