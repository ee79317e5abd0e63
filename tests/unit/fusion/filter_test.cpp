// SPDX-License-Identifier: Apache-2.0
#include "pharos/fusion/filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "pharos/fusion/target_estimator.hpp"

namespace pharos::fusion {
namespace {

Settings two_sources() {
  Settings settings;
  SourceSettings absolute;
  absolute.T_vehicle_sensor = {rotation_exp(Vector3(0.1, 0.2, -0.1)), {0.3, -0.2, 0.1}};
  absolute.bias_covariance = Matrix6::Identity() * 1e-6;
  settings.sources.push_back(absolute);
  SourceSettings relative = absolute;
  relative.relative = true;
  relative.bias_frame = BiasFrame::kFeature;
  settings.sources.push_back(relative);
  return settings;
}

TargetMeasurement measured(std::uint8_t source, const TargetPose& pose, double sigma) {
  TargetMeasurement m;
  m.source = source;
  m.pose = pose;
  m.covariance = Matrix6::Identity() * (sigma * sigma);
  return m;
}

const TargetPose kSomePose{rotation_exp(Vector3(0.5, -0.2, 0.9)), {0.2, 0.1, 2.5}};

Filter started(const Settings& settings) {
  Filter filter;
  filter.start(measured(0, kSomePose, 1e-3), settings, nullptr);
  return filter;
}

TEST(FusionFilter, StartsWithTheMeasurementsCovarianceAndItsBias) {
  const Settings settings = two_sources();
  const Filter filter = started(settings);
  // Noise and bias add up; the bias' rotation acts with the arm from the sensor to the target.
  const Vector3 arm = kSomePose.t - settings.sources[0].T_vehicle_sensor.t;
  const Matrix3 position = 2e-6 * Matrix3::Identity() + 1e-6 * skew(arm) * skew(arm).transpose();
  EXPECT_LT((filter.pose_covariance().topLeftCorner<3, 3>() - 2e-6 * Matrix3::Identity()).norm(), 1e-10);
  EXPECT_LT((filter.pose_covariance().bottomRightCorner<3, 3>() - position).norm(), 1e-9);
  EXPECT_LT(pose_difference(filter.mean().pose, kSomePose).norm(), 1e-12);
}

TEST(FusionFilter, ARelativeSourceChangesNothingWhenItIsAligned) {
  const Settings settings = two_sources();
  Filter filter = started(settings);
  const Matrix6 before = filter.pose_covariance();
  Vector6 offset;
  offset << 0.4, -0.7, 0.2, 0.5, 1.0, -2.0;
  filter.align(measured(1, kSomePose.moved_by(offset), 1e-3), settings);
  EXPECT_LT(pose_difference(filter.mean().pose, kSomePose).norm(), 1e-9);
  EXPECT_LT((filter.pose_covariance() - before).norm(), 1e-3 * before.norm());
  // The same pose again agrees exactly.
  const Innovation again = filter.innovation(measured(1, kSomePose.moved_by(offset), 1e-3), settings);
  EXPECT_LT(again.nis, 1e-9);
}

TEST(FusionFilter, DirectionsThatWereNotMeasuredStayAsWideAsTheyWere) {
  const Settings settings = two_sources();
  const Vector3 axis = kSomePose.R.col(2);
  TargetMeasurement first = measured(0, kSomePose, 1e-3);
  first.directions = Directions::without_rotation_about(axis);
  const TargetPose reference{rotation_exp(0.7 * axis) * kSomePose.R, kSomePose.t};
  Filter filter;
  filter.start(first, settings, &reference);
  // The rotation about the axis is the reference's, 1 rad wide; all other directions are measured.
  EXPECT_NEAR(rotation_angle_between(filter.mean().pose.R, reference.R), 0.0, 1e-6);
  EXPECT_NEAR(axis.dot(filter.pose_covariance().topLeftCorner<3, 3>() * axis), 1.0, 1e-3);
  // A hundred noisy measurements of the other directions do not make it narrower by more than a little.
  for (int k = 0; k < 100; ++k) {
    const double tilt = k % 2 == 0 ? 2e-3 : -2e-3;
    TargetMeasurement m = measured(0, {rotation_exp(Vector3(tilt, -tilt, 0)) * kSomePose.R, kSomePose.t}, 3e-3);
    m.directions = Directions::without_rotation_about(m.pose.R.col(2));
    const Innovation in = filter.innovation(m, settings);
    ASSERT_TRUE(in.ok);
    filter.correct(in, 0, settings);
  }
  EXPECT_GT(axis.dot(filter.pose_covariance().topLeftCorner<3, 3>() * axis), 0.5);
}

TEST(FusionFilter, CommonNoiseOfASourceDoesNotAverageOut) {
  const Settings settings = two_sources();
  Filter filter = started(settings);
  for (int k = 0; k < 2000; ++k) {
    filter.predict(0.01, settings);
    const Innovation in = filter.innovation(measured(0, kSomePose, 1e-3), settings);
    filter.correct(in, 0, settings);
  }
  // White noise of 1 mm, 2000 times, would leave 0.1 mm; the bias of 1 mm stays.
  EXPECT_GT(filter.pose_covariance().diagonal().tail(3).minCoeff(), 0.9e-6);
}

// The slow error of its only source is as large as the noise that it states.
std::unique_ptr<TargetEstimator> one_source_with_slow_error(double prior_variance, double time_constant_s) {
  Settings settings;
  SourceSettings source;
  source.bias_frame = BiasFrame::kFeature;
  source.bias_covariance = Matrix6::Identity() * prior_variance;
  source.own_rotation_ratio = source.own_position_ratio = 1.0;
  source.bias_time_constant_s = time_constant_s;
  settings.sources.push_back(source);
  return std::make_unique<TargetEstimator>(settings);
}

// The k-th measurement of a target at rest.
Measurement at_rest(std::int64_t time_ns, int k, double sigma) {
  Vector6 noise;
  for (int i = 0; i < 6; ++i) noise[i] = sigma * std::sin(k * (1.7 + 0.31 * i));
  const TargetPose seen = kSomePose.moved_by(noise);
  Measurement m;
  m.time_ns = time_ns;
  m.pose = {seen.R, seen.t};
  m.covariance = Matrix6::Identity() * (sigma * sigma);
  return m;
}

// A source's slow error goes with the noise that it states. A target at rest, a stated noise that wavers by 15 %: the
// error neither wavers with it nor becomes known, so the state is never surer than that error.
TEST(FusionFilter, AStatedNoiseThatWaversDoesNotMeasureTheSlowError) {
  constexpr double kSigma = 1e-4, kRate_hz = 60.0;
  const auto estimator = one_source_with_slow_error(1e-12, 300.0);
  std::int64_t time_ns = 0;
  for (int k = 0; k < 1800; ++k) {
    const double time_s = k / kRate_hz;
    time_ns = std::llround(time_s * 1e9);
    estimator->push(at_rest(time_ns, k, kSigma * (1.0 + 0.15 * std::sin(1.9 * time_s))));
  }
  const TargetState state = estimator->state(time_ns);
  ASSERT_TRUE(state.valid);
  for (int i = 0; i < 6; ++i) EXPECT_GT(std::sqrt(state.covariance(i, i)), 0.8 * kSigma) << i;
}

// An approach: the stated noise falls by 2 % a second. The slow error is followed in steps, in the mean as it is.
TEST(FusionFilter, ASlowErrorThatFallsWithTheNoiseIsNotOverstatedInTheMean) {
  constexpr double kRate_hz = 60.0, kFall_per_s = 0.02;
  const auto estimator = one_source_with_slow_error(1e-14, 30.0);
  double ratios = 0.0;
  int count = 0;
  for (int k = 0; k < 6000; ++k) {
    const double sigma = 1e-3 * std::exp(-kFall_per_s * k / kRate_hz);
    const std::int64_t time_ns = std::llround(k / kRate_hz * 1e9);
    estimator->push(at_rest(time_ns, k, sigma));
    if (k < 1200 || k % 10 != 0) continue;
    ratios += std::sqrt(estimator->state(time_ns).covariance(3, 3)) / sigma;
    ++count;
  }
  EXPECT_NEAR(ratios / count, 1.0, 0.09);
}

}  // namespace
}  // namespace pharos::fusion
