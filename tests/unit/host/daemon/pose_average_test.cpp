// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/pose_average.hpp"

#include <gtest/gtest.h>

#include <random>

#include "pharos/geometry/symmetric.hpp"

namespace pharos::host {
namespace {

constexpr std::int64_t kPeriod_ns = 33'333'333;
using CameraFromTarget = Pose<frame::Camera, frame::Target>;

CameraFromTarget near_half_turn() { return {rotation_exp(Vector3(3.0, 0.2, -0.1)), Vector3(0.1, -0.2, 4.0)}; }

Matrix6 covariance() {
  Matrix6 result = Matrix6::Zero();
  result.diagonal() << 4e-6, 4e-6, 1e-6, 1e-8, 1e-8, 4e-8;
  result(0, 4) = result(4, 0) = 1e-7;
  return result;
}

/// Frames scattered about a pose with the stated standard deviations times `widen`.
class Frames {
 public:
  explicit Frames(unsigned seed) : random_(seed) {}
  AveragedFrame next(double widen = 1.0) {
    const Matrix6 root = covariance().llt().matrixL();
    Vector6 noise;
    for (int i = 0; i < 6; ++i) noise[i] = normal_(random_);
    AveragedFrame frame;
    frame.estimate.pose = near_half_turn().moved_by(widen * root * noise);
    frame.estimate.covariance = covariance();
    frame.utc_ns = (time_ns_ += kPeriod_ns);
    frame.observations = 10;
    return frame;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::int64_t time_ns_ = 0;
};

TEST(PoseAverage, ReportsTheMeanAndItsCovarianceOnceTheWindowIsFull) {
  Frames frames(1);
  PoseAverage average(100);
  for (int i = 0; i < 99; ++i) ASSERT_FALSE(average.push(frames.next()));
  const auto mean = average.push(frames.next());
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->observations, 1000);
  EXPECT_FALSE(mean->moving);
  EXPECT_NEAR(static_cast<double>(mean->utc_ns), 50.5 * static_cast<double>(kPeriod_ns), 2.0);
  EXPECT_LT((mean->estimate.covariance - covariance() / 100.0).norm(), 0.3 * (covariance() / 100.0).norm());
  EXPECT_FALSE(average.push(frames.next())) << "no frame is in two means";
}

// The mean of the normalised squared errors of 200 averages is 6 (chi-squared, six degrees of freedom) within 3 sigma.
TEST(PoseAverage, IsAsGoodAsItSays) {
  Frames frames(2);
  PoseAverage average(20);
  double sum = 0.0;
  constexpr int kMeans = 200;
  for (int i = 0; i < kMeans; ++i) {
    std::optional<WindowMean> mean;
    while (!mean) mean = average.push(frames.next());
    const Vector6 error = pose_difference(mean->estimate.pose, near_half_turn());
    sum += mahalanobis_squared<6>(error, mean->estimate.covariance);
  }
  EXPECT_NEAR(sum / kMeans, 6.0, 3.0 * std::sqrt(12.0 / kMeans) + 0.3);
}

TEST(PoseAverage, WidensAndSaysMovingWhereFramesScatterMoreThanTheyClaim) {
  Frames frames(3);
  PoseAverage average(50);
  std::optional<WindowMean> mean;
  while (!mean) mean = average.push(frames.next(3.0));
  EXPECT_TRUE(mean->moving);
  const double ratio = mean->estimate.covariance.trace() / (covariance().trace() / 50.0);
  EXPECT_NEAR(ratio, 9.0, 2.5);
}

TEST(PoseAverage, BeginsAnewAfterAGapAndAtOtherFlags) {
  Frames frames(4);
  PoseAverage average(3);
  average.push(frames.next());
  AveragedFrame other = frames.next();
  other.flags = "no_connector";
  EXPECT_FALSE(average.push(other));
  EXPECT_EQ(average.discarded(), 1);
  AveragedFrame late = other;
  late.utc_ns += 2 * PoseAverage::kLongestGap_ns;
  EXPECT_FALSE(average.push(late));
  EXPECT_EQ(average.discarded(), 2);
  late.utc_ns += kPeriod_ns;
  EXPECT_FALSE(average.push(late));
  late.utc_ns += kPeriod_ns;
  const auto mean = average.push(late);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->flags, "no_connector");
}

}  // namespace
}  // namespace pharos::host
