// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/approach/approach_truth.hpp"

#include <gtest/gtest.h>

#include "pharos/base/units.hpp"

namespace pharos::sim {
namespace {

ApproachMotion still_vehicle() {
  ApproachMotion motion;
  motion.attitude_sway_deg = 0.0;
  motion.sway_m = 0.0;
  motion.rate_deg_s = 3.0;
  motion.nutation_deg = 8.0;
  return motion;
}

TEST(ApproachTruth, GoesFromStartToEnd) {
  const ApproachTruth truth(still_vehicle(), 3);
  const double wobble_m = 0.6 * (1.0 - std::cos(8.0 * kRadPerDeg)) + 1e-6;  // of the origin about the centre of mass
  EXPECT_NEAR(truth.at(0.0).t.z(), 20.0, wobble_m);
  EXPECT_NEAR(truth.at(300.0).t.z(), 0.4, wobble_m);
  for (double t = 1.0; t < 300.0; t += 1.0) EXPECT_LT(truth.at(t).t.z(), truth.at(t - 1.0).t.z() + 0.02);
}

// Free of torque: the angular momentum J w is constant in inertial space, and the rate has the magnitude asked for.
TEST(ApproachTruth, ConservesTheAngularMomentum) {
  const ApproachMotion motion = still_vehicle();
  const ApproachTruth truth(motion, 5);
  const Vector3 inertia(1.0, 1.0, motion.inertia_ratio);
  Vector3 first = Vector3::Zero();
  for (double t = 1.0; t < 200.0; t += 7.0) {
    const Matrix3 R = truth.at(t).R;
    const Vector3 rate = truth.rates(t).rate_rad_s;
    const Vector3 momentum = R * (inertia.cwiseProduct(R.transpose() * rate));
    if (first.isZero()) first = momentum;
    EXPECT_LT((momentum - first).norm(), 1e-6 * first.norm());
    EXPECT_NEAR(rate.norm() * kDegPerRad, motion.rate_deg_s, 1e-6);
    EXPECT_LT(momentum.normalized().dot(Vector3::UnitZ()), -0.999999);
  }
}

TEST(ApproachTruth, RatesAreTheDerivativesOfThePose) {
  const ApproachTruth truth(ApproachMotion{}, 7);
  const double t = 100.0, h = 0.01;
  const ApproachTruth::Rates rates = truth.rates(t);
  const Vector6 moved = pose_difference(truth.at(t + h), truth.at(t - h)) / (2.0 * h);
  EXPECT_LT((moved.tail<3>() - rates.velocity_m_s).norm(), 1e-6);
  EXPECT_LT((moved.head<3>() - rates.rate_rad_s).norm(), 1e-6);
}

TEST(ApproachTruth, AManoeuvreTurnsAboutAllAxes) {
  ApproachMotion motion;
  motion.form = ApproachMotion::Form::kManoeuvre;
  motion.start_m = 2.5;
  const ApproachTruth truth(motion, 2);
  Vector3 low = Vector3::Constant(1e9), high = -low;
  for (double t = 0.0; t < 60.0; t += 0.1) {
    const Vector3 turn = rotation_log(truth.at(t).R * truth.at(0.0).R.transpose());
    low = low.cwiseMin(turn);
    high = high.cwiseMax(turn);
  }
  EXPECT_GT((high - low).minCoeff(), 15.0 * kRadPerDeg);
}

}  // namespace
}  // namespace pharos::sim
