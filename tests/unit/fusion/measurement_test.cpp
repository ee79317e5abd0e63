// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/measurement.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pharos/fusion/chi_squared.hpp"
#include "pharos/fusion/protection.hpp"
#include "pharos/fusion/settings.hpp"
#include "pharos/fusion/source_view.hpp"

namespace pharos::fusion {
namespace {

Measurement sound() {
  Measurement m;
  m.covariance = Matrix6::Identity() * 1e-6;
  m.pose.t = Vector3(0, 0, 2);
  return m;
}

Settings one_source() {
  Settings settings;
  settings.sources.push_back(SourceSettings{});
  return settings;
}

TEST(FusionMeasurement, AcceptsASoundPose) { EXPECT_EQ(check_measurement(sound(), 1), Refusal::kNone); }

TEST(FusionMeasurement, RefusesASourceThatIsNotThere) {
  Measurement m = sound();
  m.source = 1;
  EXPECT_EQ(check_measurement(m, 1), Refusal::kUnknownSource);
}

TEST(FusionMeasurement, RefusesWhatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Measurement m = sound();
    m.pose.t.y() = bad;
    EXPECT_EQ(check_measurement(m, 1), Refusal::kNotFinite);
    m = sound();
    m.pose.R(1, 2) = bad;
    EXPECT_EQ(check_measurement(m, 1), Refusal::kNotFinite);
    m = sound();
    m.covariance(3, 4) = bad;
    EXPECT_EQ(check_measurement(m, 1), Refusal::kNotFinite);
  }
}

TEST(FusionMeasurement, RefusesAMatrixThatIsNoRotation) {
  Measurement m = sound();
  m.pose.R = -Matrix3::Identity();
  EXPECT_EQ(check_measurement(m, 1), Refusal::kNotFinite);
}

TEST(FusionMeasurement, RefusesACovarianceThatIsNone) {
  Measurement m = sound();
  m.covariance(2, 2) = -1e-6;
  EXPECT_EQ(check_measurement(m, 1), Refusal::kCovariance);
  m = sound();
  m.covariance(0, 1) = m.covariance(1, 0) = 2e-6;
  EXPECT_EQ(check_measurement(m, 1), Refusal::kCovariance);
  m = sound();
  m.covariance(0, 1) = 5e-7;
  EXPECT_EQ(check_measurement(m, 1), Refusal::kCovariance);
  m.covariance = Matrix6::Zero();
  EXPECT_EQ(check_measurement(m, 1), Refusal::kCovariance);
}

TEST(FusionMeasurement, IgnoresTheCovarianceOfWhatWasNotMeasured) {
  Measurement m = sound();
  m.covariance(2, 2) = 0.0;
  EXPECT_EQ(check_measurement(m, 1), Refusal::kCovariance);
  m.directions = Directions::without_rotation_about(Vector3::UnitZ());
  EXPECT_EQ(check_measurement(m, 1), Refusal::kNone);
}

TEST(FusionMeasurement, AnUnmeasuredAxisIsNotHeldByTheDirections) {
  const Vector3 axis = Vector3(0.3, -0.5, 0.8).normalized();
  const Directions directions = Directions::without_rotation_about(axis);
  Vector6 about, across;
  about << axis, Vector3::Zero();
  across << axis.unitOrthogonal(), Vector3::Zero();
  EXPECT_NEAR(directions.fraction_of(about), 0.0, 1e-12);
  EXPECT_NEAR(directions.fraction_of(across), 1.0, 1e-12);
}

TEST(FusionMeasurement, MapsErrorsOfTheSensorIntoTheVehicle) {
  SourceSettings source;
  source.T_vehicle_sensor = {rotation_exp(Vector3(0.3, -0.4, 1.1)), {0.2, 0.5, -0.3}};
  source.T_target_feature = {rotation_exp(Vector3(-0.6, 0.2, 0.4)), {0.4, -0.2, 0.7}};
  Measurement m = sound();
  m.pose = {rotation_exp(Vector3(1.0, 0.5, -0.2)), {0.3, 0.1, 2.0}};
  for (int axis = 0; axis < 6; ++axis) {
    constexpr double kStep = 1e-6;
    m.covariance = Matrix6::Zero();
    m.covariance(axis, axis) = 1.0;
    const TargetMeasurement mapped = to_target(m, source, source.T_target_feature, nullptr);
    Measurement moved = m;
    moved.pose = m.pose.moved_by(Vector6::Unit(axis) * kStep);
    const Vector6 delta =
        pose_difference(to_target(moved, source, source.T_target_feature, nullptr).pose, mapped.pose) / kStep;
    EXPECT_LT((mapped.covariance - delta * delta.transpose()).norm(), 1e-5);
  }
}

TEST(FusionSettings, RefuseWhatNoRigHas) {
  EXPECT_EQ(check_settings(Settings{}), SettingsError::kNoSource);
  EXPECT_EQ(check_settings(one_source()), SettingsError::kNone);
  Settings settings = one_source();
  settings.sources[0].relative = true;
  EXPECT_EQ(check_settings(settings), SettingsError::kNoAbsoluteSource);
  settings = one_source();
  settings.sources[0].bias_covariance(0, 0) = 0.0;
  EXPECT_EQ(check_settings(settings), SettingsError::kBiasModel);
  settings = one_source();
  settings.sources[0].T_vehicle_sensor.t.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_settings(settings), SettingsError::kMounting);
  settings = one_source();
  settings.motion.inertia_ratios = Vector3(1, 1, 3);
  EXPECT_EQ(check_settings(settings), SettingsError::kMotion);
  settings = one_source();
  settings.integrity.risk_per_hour = 0.0;
  EXPECT_EQ(check_settings(settings), SettingsError::kProbability);
}

// Percentage points of chi-squared: Abramowitz and Stegun, table 26.8.
TEST(ChiSquared, HasTheTabulatedPercentagePoints) {
  EXPECT_NEAR(chi_squared_bound(0.05, 1), 3.841, 1e-3);
  EXPECT_NEAR(chi_squared_bound(0.01, 2), 9.210, 1e-3);
  EXPECT_NEAR(chi_squared_bound(0.001, 3), 16.266, 1e-3);
  EXPECT_NEAR(chi_squared_bound(0.01, 5), 15.086, 1e-3);
  EXPECT_NEAR(chi_squared_bound(0.05, 6), 12.592, 1e-3);
}

TEST(Protection, TakesMoreSigmasForASmallerRiskAndForMoreFaults) {
  Settings settings = one_source();
  const ProtectionFactors usual = protection_factors(settings);
  settings.integrity.risk_per_hour = 1e-7;
  EXPECT_GT(protection_factors(settings).fault_free, usual.fault_free);
  settings = one_source();
  settings.sources[0].faults_per_hour.fill(1.0);
  EXPECT_GT(protection_factors(settings).without[0], usual.without[0]);
  settings.sources[0].faults_per_hour.fill(0.0);
  EXPECT_EQ(protection_factors(settings).without[0], 0.0);
}

// Of two solutions that are alike in a direction neither is the surer one but by rounding: the 2 % by which P may
// exceed P_i there is no variance of the difference.
TEST(SolutionSeparation, AlikeSolutionsAreNotSeparatedByRounding) {
  const Matrix3 turn = rotation_exp({0.4, -0.3, 0.8});
  const auto turned = [&](const Vector3& variances) {
    return Matrix3(turn * variances.asDiagonal() * turn.transpose());
  };
  const Matrix3 P_i = turned({1e-8, 4e-8, 9e-6});
  const Vector3 a_third_of_a_sigma = turn * Vector3(3.3e-5, 0.0, 0.0);
  for (const double ratio : {1.0, 1.01, 1.0199999, 1.02, 1.1}) {
    const double chi2 = separation_chi2(a_third_of_a_sigma, P_i, turned({ratio * 1e-8, 1e-8, 1e-7}));
    EXPECT_NEAR(chi2, 0.33 * 0.33 / 0.02, 1e-6) << ratio;
  }
}

// Where the source does tell something the difference has the variance that it should.
TEST(SolutionSeparation, IsTheDifferenceInItsOwnSigmas) {
  const Matrix3 P_i = Vector3(4e-6, 9e-6, 1e-6).asDiagonal();
  const Matrix3 P = Vector3(1e-6, 1e-6, 5e-7).asDiagonal();
  const Vector3 d(2e-3, -3e-3, 1e-3);
  EXPECT_NEAR(separation_chi2(d, P_i, P), 1.0 / 0.77 + 1.0 / (8.0 / 9.0 + 0.02) + 1.0 / 0.52, 1e-9);
  EXPECT_EQ(separation_chi2(d, Matrix3::Zero(), P), 0.0);
}

}  // namespace
}  // namespace pharos::fusion
