// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/connector_pair.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "pharos/base/units.hpp"
#include "pharos/tof/tof_pose.hpp"

namespace pharos::tof {
namespace {

constexpr double kPlaceSigma_m = 0.0015, kHeightSigma_m = 0.004;

// A ring 6 m away with connectors at places of T; frames of it as measured, with or without noise.
struct Body {
  std::array<Vector2, 2> places_m = {Vector2(0.36, 0.0), Vector2(0.1, 0.7)};
  std::array<double, 2> heights_m = {-0.003, -0.008};

  TofPose seen_at(const CameraFromTarget& truth, double noise, std::mt19937& random) const {
    std::normal_distribution<double> normal(0.0, noise);
    TofPose pose;
    RingFit& ring = pose.ring.fit;
    ring.model = {truth.t, truth.R.col(2), {0.56, 0.53}};
    ring.covariance.setIdentity();
    ring.covariance *= 1e-10;
    const PlaneAxes axes = axes_of(ring.model.normal);
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3 in_C = truth.R * Vector3(places_m[k].x(), places_m[k].y(), 0.0);
      const double off_height = kHeightSigma_m * normal(random);
      SeenConnector one;
      one.sure = true;
      one.face.height_m = heights_m[k] + off_height;
      one.face.sigma_height_m = kHeightSigma_m;
      // The face stays on its ray where its height is wrong.
      const Vector3 ray = truth.t + in_C + heights_m[k] * ring.model.normal;
      const Vector3 per_height = ray / ring.model.normal.dot(ray);
      const Vector2 off(kPlaceSigma_m * normal(random), kPlaceSigma_m * normal(random));
      one.face.rectangle.centre_m = Vector2(axes.first.dot(in_C), axes.second.dot(in_C)) + off +
                                    off_height * Vector2(axes.first.dot(per_height), axes.second.dot(per_height));
      one.face.rectangle.half_sides_m = {0.037, 0.037};
      one.face.covariance = kPlaceSigma_m * kPlaceSigma_m * Matrix2::Identity();
      one.face.edge_points = 100;
      pose.seen.push_back(one);
    }
    pose.connector = pose.seen[0].face;
    pose.target = target_pose(ring, pose.connector);
    return pose;
  }
};

CameraFromTarget any_pose(std::mt19937& random) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  CameraFromTarget pose;
  pose.R = attitude_of({0.3 * any(random), 0.3 * any(random), kPi * any(random)});
  pose.t = {0.2 * any(random), 0.2 * any(random), 6.0};
  return pose;
}

// About Z', rad.
double turn_error(const TofPose& pose, const CameraFromTarget& truth) {
  const Matrix3 off = truth.R.transpose() * pose.target.pose.R;
  return std::atan2(off(1, 0), off(0, 0));
}
double turn_variance(const TofPose& pose) {
  const Vector3 normal = pose.ring.fit.model.normal;
  return normal.dot(pose.target.covariance.topLeftCorner<3, 3>() * normal);
}

TEST(ConnectorPairs, TheFirstFrameStaysAsItIs) {
  std::mt19937 random(1);
  const TofPose measured = Body{}.seen_at(any_pose(random), 1.0, random);
  TofPose pose = measured;
  ConnectorPair pair;
  pair.refine(pose);
  EXPECT_EQ(pose.target.pose.R, measured.target.pose.R);
  EXPECT_EQ(pose.target.covariance, measured.target.covariance);
  EXPECT_EQ(pair.frames(), 1);
}

// The farther connector alone gives it twice as well.
TEST(ConnectorPairs, BothGiveTheTurnWithAnHonestSigma) {
  std::mt19937 random(2);
  double alone = 0.0, both = 0.0, normalised = 0.0;
  int frames = 0;
  for (int recording = 0; recording < 40; ++recording) {
    ConnectorPair pair;
    for (int k = 0; k < 50; ++k) {
      const CameraFromTarget truth = any_pose(random);
      TofPose pose = Body{}.seen_at(truth, 1.0, random);
      if (k >= 10) alone += std::pow(turn_error(pose, truth), 2);
      pair.refine(pose);
      const double error = turn_error(pose, truth);
      normalised += error * error / turn_variance(pose);
      ++frames;
      if (k >= 10) both += error * error;
    }
  }
  EXPECT_LT(std::sqrt(both / alone), 0.5);
  EXPECT_GT(normalised / frames, 0.8);
  EXPECT_LT(normalised / frames, 1.2);
}

TEST(ConnectorPairs, AMovedTargetIsFollowedAtOnce) {
  std::mt19937 random(3);
  ConnectorPair pair;
  for (int k = 0; k < 20; ++k) {
    const CameraFromTarget truth = any_pose(random);
    TofPose pose = Body{}.seen_at(truth, 0.0, random);
    pair.refine(pose);
    EXPECT_LT(std::fabs(turn_error(pose, truth)), 1e-9) << k;
  }
  EXPECT_EQ(pair.frames(), 20);
}

TEST(ConnectorPairs, WhatAllFramesOfAViewShareIsNotAveragedAway) {
  std::mt19937 random(4);
  const CameraFromTarget truth = any_pose(random);
  ConnectorPair pair;
  TofPose pose;
  for (int k = 0; k < 100; ++k) {
    pose = Body{}.seen_at(truth, 1.0, random);
    for (SeenConnector& one : pose.seen) {
      one.face.common_variance_m2 = 1e-6;
      one.face.covariance += 1e-6 * Matrix2::Identity();
    }
    pose.target = target_pose(pose.ring.fit, pose.seen[0].face);
    pair.refine(pose);
  }
  EXPECT_GT(std::sqrt(turn_variance(pose)), 1e-3 / 0.36);
}

TEST(ConnectorPairs, AnotherBodyIsLearntAnewAndUntilThenEachFrameStandsAlone) {
  std::mt19937 random(5);
  ConnectorPair pair;
  for (int k = 0; k < 10; ++k) {
    TofPose pose = Body{}.seen_at(any_pose(random), 1.0, random);
    pair.refine(pose);
  }
  Body other;
  other.places_m[1] = {0.2, 0.68};  // as far away, 9 deg nearer
  for (int k = 0; k < 10; ++k) {
    const CameraFromTarget truth = any_pose(random);
    TofPose pose = other.seen_at(truth, 1.0, random);
    const Matrix3 before = pose.target.pose.R;
    pair.refine(pose);
    if (k < 3) {
      EXPECT_EQ(pose.target.pose.R, before) << k;
    }
    EXPECT_LT(std::fabs(turn_error(pose, truth)), 0.02) << k;
  }
  EXPECT_EQ(pair.frames(), 8);
}

TEST(ConnectorPairs, PosesThatShowNoPairOrAreAmbiguousStayAndTeachNothing) {
  std::mt19937 random(6);
  ConnectorPair pair;
  const auto is_left_alone = [&](TofPose pose) {
    const Matrix3 before = pose.target.pose.R;
    pair.refine(pose);
    return pose.target.pose.R == before && pair.frames() == 1;
  };
  TofPose pose = Body{}.seen_at(any_pose(random), 1.0, random);
  pair.refine(pose);
  const TofPose whole = Body{}.seen_at(any_pose(random), 1.0, random);
  pose = whole;
  pose.second = pose.target;
  EXPECT_TRUE(is_left_alone(pose));
  pose = whole;
  pose.flags = kFlagNoConnector;
  EXPECT_TRUE(is_left_alone(pose));
  pose = whole;
  pose.seen[1].sure = false;
  EXPECT_TRUE(is_left_alone(pose));
  pose = whole;
  pose.seen.clear();
  pose.seen.push_back(whole.seen[0]);
  EXPECT_TRUE(is_left_alone(pose));
  EXPECT_FALSE(is_left_alone(whole));
}

}  // namespace
}  // namespace pharos::tof
