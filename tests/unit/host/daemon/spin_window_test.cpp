// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/spin_window.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pharos::host {
namespace {

constexpr double kStep_s = 0.05;

// A target that rotates at `rate`; attitude noise of `sigma_rad` per component.
class Turning {
 public:
  explicit Turning(const Vector3& rate_rad_s, double sigma_rad = 1e-4) : rate_(rate_rad_s), sigma_(sigma_rad) {}
  slam::TrackedFrame frame(int k) {
    std::normal_distribution<double> noise(0.0, sigma_);
    const double x = noise(random_), y = noise(random_), z = noise(random_);
    slam::TrackedFrame out;
    out.time_s = kStep_s * k;
    out.placed = slam::TrackedPose{};
    out.placed->pose.R = rotation_exp(Vector3(x, y, z)) * rotation_exp(rate_ * out.time_s);
    return out;
  }

 private:
  Vector3 rate_;
  double sigma_;
  std::mt19937_64 random_{1};
};

TEST(SpinWindow, ReportsRateAndAxisOnceASecond) {
  const Vector3 rate(0.02, -0.16, 0.05);
  Turning target(rate);
  SpinWindow window;
  std::vector<SpinResult> told;
  for (int k = 0; k <= 60; ++k) {
    if (const auto answer = window.push(target.frame(k))) told.push_back(*answer);
  }
  ASSERT_EQ(told.size(), 4U);
  EXPECT_EQ(told[0].refusal, "too_few");
  const SpinEstimate& spin = told[3].spin;
  EXPECT_EQ(told[3].refusal, "");
  const Vector3 off = spin.rate_rad_s - rate;
  EXPECT_LT(off.dot(spin.covariance.inverse() * off), 16.3) << "0.1 % of chi-squared, three degrees of freedom";
  EXPECT_GT(spin.axis.dot(rate.normalized()), 0.99999);
  EXPECT_LT(spin.sigma_rate_rad_s, 1e-3);
  EXPECT_GT(spin.sigma_axis_rad, 0.0);
  EXPECT_EQ(spin.attitudes, 61);
  EXPECT_NEAR(spin.span_s, 3.0, 1e-9);
}

TEST(SpinWindow, KnowsOnlyTheLastSecondsAndTheMapAtHand) {
  Turning before(Vector3(0.0, 0.1, 0.0)), after(Vector3(0.0, 0.0, -0.1));
  SpinWindow window;
  std::optional<SpinResult> last;
  const auto show = [&](Turning& target, int first, int end) {
    for (int k = first; k < end; ++k) {
      if (const auto answer = window.push(target.frame(k))) last = answer;
    }
  };
  show(before, 0, 30);
  window.clear();
  show(after, 30, 61);
  EXPECT_EQ(last->spin.attitudes, 31);
  EXPECT_LT((last->spin.rate_rad_s - Vector3(0.0, 0.0, -0.1)).norm(), 1e-3);
  show(after, 61, 1001);
  EXPECT_LE(last->spin.span_s, 20.0);
}

TEST(SpinWindow, ATargetAtRestHasNoAxis) {
  Turning target(Vector3::Zero(), 1e-3);
  SpinWindow window;
  std::optional<SpinResult> last;
  for (int k = 0; k <= 40; ++k) {
    if (const auto answer = window.push(target.frame(k))) last = answer;
  }
  EXPECT_EQ(last->refusal, "");
  EXPECT_EQ(last->spin.axis, Vector3::Zero());
  EXPECT_EQ(last->spin.sigma_axis_rad, 0.0);
}

TEST(SpinWindow, WhileLostThereIsNone) {
  Turning target(Vector3(0.0, 0.1, 0.0));
  SpinWindow window;
  for (int k = 0; k < 20; ++k) window.push(target.frame(k));
  slam::TrackedFrame lost;
  lost.time_s = 1.0;
  lost.lost = true;
  const auto answer = window.push(lost);
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->refusal, "lost");
}

}  // namespace
}  // namespace pharos::host
