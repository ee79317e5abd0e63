// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/target_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/geometry/positive_inverse.hpp"

namespace pharos::tof {
namespace {

TargetAngles degrees(double alpha, double beta, double gamma) {
  return {alpha * kRadPerDeg, beta * kRadPerDeg, gamma * kRadPerDeg};
}

TEST(TargetFrame, AnglesAreThePapersForAFacingTarget) {
  // X' turned 40 deg clockwise in the image (towards +v) is gamma -40.
  Matrix3 R;
  R.col(0) = Vector3(std::cos(40 * kRadPerDeg), std::sin(40 * kRadPerDeg), 0.0);
  R.col(2) = Vector3(0.0, 0.0, -1.0);
  R.col(1) = R.col(2).cross(R.col(0));
  const TargetAngles angles = angles_of(R);
  EXPECT_NEAR(angles.gamma_rad * kDegPerRad, -40.0, 1e-12);
  EXPECT_NEAR(angles.alpha_rad, 0.0, 1e-15);
  EXPECT_NEAR(angles.beta_rad, 0.0, 1e-15);
}

TEST(TargetFrame, AnglesAndAttitudeAreInverse) {
  for (const double alpha : {-35.0, 2.19, 30.0}) {
    for (const double beta : {-30.0, -1.12, 34.0}) {
      for (const double gamma : {-179.0, -40.03, 0.0, 120.0}) {
        const TargetAngles back = angles_of(attitude_of(degrees(alpha, beta, gamma)));
        EXPECT_NEAR(back.alpha_rad * kDegPerRad, alpha, 1e-10);
        EXPECT_NEAR(back.beta_rad * kDegPerRad, beta, 1e-10);
        EXPECT_NEAR(back.gamma_rad * kDegPerRad, gamma, 1e-10);
      }
    }
  }
}

TEST(TargetFrame, PrintedArctanHoldsWithinNinetyDegrees) {
  const Matrix3 R = Vector3(1.0, -1.0, -1.0).asDiagonal() * attitude_of(degrees(3.0, -2.0, -75.0));
  const TargetAngles angles = angles_of(attitude_of(degrees(3.0, -2.0, -75.0)));
  EXPECT_NEAR(std::atan(-R(1, 2) / R(2, 2)), angles.alpha_rad, 1e-12);
  EXPECT_NEAR(std::asin(R(0, 2)), angles.beta_rad, 1e-12);
  EXPECT_NEAR(std::atan(-R(0, 1) / R(0, 0)), angles.gamma_rad, 1e-12);
}

// A ring and a connector's face whose uncertainties are unlike, so that no two can be mistaken for each other.
RingFit some_ring(const Matrix3& R, const Vector3& centre) {
  RingFit ring;
  ring.model = {centre, R.col(2), {0.55, 0.49}};
  const std::array<double, 7> sigmas = {1e-3, 2e-3, 1e-4, 2e-4, 5e-4, 1e-4, 1e-4};
  for (int k = 0; k < 7; ++k)
    ring.covariance(k, k) = sigmas[static_cast<std::size_t>(k)] * sigmas[static_cast<std::size_t>(k)];
  return ring;
}

ConnectorFace face_at(const RingFit& ring, const Vector3& point) {
  const PlaneAxes axes = axes_of(ring.model.normal);
  const Vector3 arm = point - ring.model.centre_m;
  ConnectorFace face;
  face.rectangle.centre_m = {axes.first.dot(arm), axes.second.dot(arm)};
  face.height_m = ring.model.normal.dot(arm);
  face.sigma_height_m = 0.002;
  face.covariance = Vector2(4e-8, 9e-8).asDiagonal();
  return face;
}

TEST(TargetFrame, XPointsAtTheConnectorAsSeenAlongTheNormal) {
  const Matrix3 R = attitude_of(degrees(12.0, -20.0, 70.0));
  const Vector3 centre(0.1, -0.2, 3.4);
  const RingFit ring = some_ring(R, centre);
  const TargetPose target = target_pose(ring, face_at(ring, centre + R * Vector3(0.66, 0.0, -0.03)));
  EXPECT_LT((target.pose.R - R).norm(), 1e-12);
  EXPECT_EQ(target.pose.t, centre);
}

TEST(TargetFrame, CovarianceCarriesAllThatWasUncertain) {
  const Matrix3 R = attitude_of(degrees(12.0, -20.0, 70.0));
  const RingFit ring = some_ring(R, Vector3(0.1, -0.2, 3.4));
  const TargetPose target = target_pose(ring, face_at(ring, ring.model.centre_m + R * Vector3(0.66, 0.0, -0.03)));
  EXPECT_TRUE(positive_inverse<6>(target.covariance)) << "not positive definite";
  const PlaneAxes axes = axes_of(ring.model.normal);
  const Matrix3 rotation = target.covariance.topLeftCorner<3, 3>();
  EXPECT_NEAR(std::sqrt(axes.first.dot(rotation * axes.first)), 1e-3, 1e-8);
  EXPECT_NEAR(std::sqrt(axes.second.dot(rotation * axes.second)), 2e-3, 1e-8);
  // The turn: 0.2 to 0.3 mm across 0.66 m by the connector, the same by the centre, and a little by tilt.
  const double turn = std::sqrt(ring.model.normal.dot(rotation * ring.model.normal));
  EXPECT_GT(turn, 0.0003 / 0.66);
  EXPECT_LT(turn, 0.001 / 0.66);
  EXPECT_NEAR(std::sqrt(target.covariance(5, 5)), 5e-4, 1e-9);
}

TEST(TargetFrame, ADescribedDirectionTurnsTheFrameAndItsErrorIsOneOfTheTurn) {
  const Matrix3 R = attitude_of(degrees(12.0, -20.0, 70.0));
  const RingFit ring = some_ring(R, Vector3(0.1, -0.2, 3.4));
  constexpr double kDirection = 0.8, kDirectionSigma = 3e-3;
  const Vector3 place(0.66 * std::cos(kDirection), 0.66 * std::sin(kDirection), -0.03);
  const ConnectorFace face = face_at(ring, ring.model.centre_m + R * place);
  const TargetPose exact = target_pose(ring, face, kDirection, 0.0);
  const TargetPose stated = target_pose(ring, face, kDirection, kDirectionSigma);
  EXPECT_LT((exact.pose.R - R).norm(), 1e-9);
  EXPECT_EQ(exact.pose.R, stated.pose.R);
  const Matrix3 more = (stated.covariance - exact.covariance).topLeftCorner<3, 3>();
  EXPECT_LT((more - kDirectionSigma * kDirectionSigma * R.col(2) * R.col(2).transpose()).norm(),
            1e-9 * kDirectionSigma * kDirectionSigma);
}

TEST(TargetFrame, WithoutAConnectorTheTurnIsAnyAndTheRestIsKnown) {
  const Matrix3 R = attitude_of(degrees(12.0, -20.0, 70.0));
  const RingFit ring = some_ring(R, Vector3(0.1, -0.2, 3.4));
  const TargetPose target = target_pose_without_turn(ring);
  const Vector3& normal = ring.model.normal;
  EXPECT_LT((target.pose.R.col(2) - normal).norm(), 1e-12);
  EXPECT_NEAR(target.pose.R.determinant(), 1.0, 1e-12);
  const Matrix3 rotation = target.covariance.topLeftCorner<3, 3>();
  EXPECT_NEAR(normal.dot(rotation * normal), kPi * kPi / 3.0, 1e-6);
  const PlaneAxes axes = axes_of(normal);
  EXPECT_NEAR(std::sqrt(axes.second.dot(rotation * axes.second)), 2e-3, 1e-8);
}

}  // namespace
}  // namespace pharos::tof
