// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/keyframe_covariance.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "host/vision/slam/trajectory_log.hpp"
#include "pharos/geometry/symmetric.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

constexpr int kKeyframes = 10, kSpan = 4, kPointsEach = 25;
constexpr double kBodyNoise_px = 0.5;

CameraFromTarget pose_at(int k) { return turned_pose(0.1 * k); }

// A rotating body: each part of it is seen from four consecutive keyframes, so that the last one is connected by a
// chain.
BundleProblem chained_views(std::mt19937_64& random) {
  BundleProblem problem;
  for (int k = 0; k < kKeyframes; ++k) {
    problem.poses[k] = pose_at(k);
    problem.fixed[k] = k == 0;
  }
  PointId id = 0;
  for (int first = 1 - kSpan; first < kKeyframes; ++first) {
    for (const Vector3& point : random_points(random, kPointsEach)) {
      problem.points[id] = point;
      for (int k = std::max(0, first); k < std::min(kKeyframes, first + kSpan); ++k) {
        problem.observations.push_back({k, id, seen(point, pose_at(k), kBodyNoise_px, random)});
      }
      ++id;
    }
  }
  return problem;
}

// zeta of T_true = T exp(zeta).
Vector6 error_of(const CameraFromTarget& pose, const CameraFromTarget& truth) {
  const auto off = pose.inverse() * truth;
  Vector6 zeta;
  zeta << rotation_log(off.R), off.t;
  return zeta;
}

double square_of(const Vector6& error, const Matrix6& covariance) { return mahalanobis_squared<6>(error, covariance); }

TEST(KeyframeCovariances, AreWhatManySolutionsScatterBy) {
  double sum = 0.0, last = 0.0;
  constexpr int kSeeds = 30;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    BundleProblem problem = chained_views(random);
    const auto rejected = adjust_bundle(problem, kCamera, 20);
    const auto covariances = keyframe_covariances(problem, rejected, kCamera, 0).independent;
    EXPECT_TRUE(covariances.at(0).isZero(0.0));
    for (int k = 1; k < kKeyframes; ++k) {
      const double square = square_of(error_of(problem.poses.at(k), pose_at(k)), covariances.at(k)) / 6.0;
      sum += square / (kSeeds * (kKeyframes - 1));
      if (k == kKeyframes - 1) last += square / kSeeds;
    }
    EXPECT_GT(covariances.at(kKeyframes - 1).trace(), 2.0 * covariances.at(1).trace()) << "no drift told";
  }
  // Six times some hundred independent numbers.
  EXPECT_GT(sum, 0.8);
  EXPECT_LT(sum, 1.25);
  EXPECT_GT(last, 0.7);
  EXPECT_LT(last, 1.4);
}

// Ten neighbours each have an error in common in each keyframe, as by light and gloss: three quarters of the variance.
TEST(KeyframeCovariances, GrowWithErrorsThatNeighboursShare) {
  double correlated = 0.0, independent = 0.0;
  constexpr int kSeeds = 10, kTogether = 10;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> noise(0.0, 0.5);
    BundleProblem problem;
    for (int k = 0; k < kKeyframes; ++k) {
      problem.poses[k] = pose_at(k);
      problem.fixed[k] = k == 0;
    }
    for (const Vector3& middle : random_points(random, 40)) {
      std::map<int, Vector2> common;
      for (int k = 0; k < kKeyframes; ++k) common[k] = {noise(random), noise(random)};
      for (int n = 0; n < kTogether; ++n) {
        const auto id = static_cast<PointId>(problem.points.size());
        problem.points[id] = middle + random_vector(random, 0.05);
        for (int k = 0; k < kKeyframes; ++k) {
          Observation at = seen(problem.points.at(id), pose_at(k), 0.29, random);
          at.pixel += common.at(k);
          at.right_u_px += common.at(k).x();
          at.variance_px2 = 0.29 * 0.29 + 0.5 * 0.5;
          problem.observations.push_back({k, id, at});
        }
      }
    }
    const auto rejected = adjust_bundle(problem, kCamera, 20);
    const auto covariances = keyframe_covariances(problem, rejected, kCamera, 0);
    for (int k = 1; k < kKeyframes; ++k) {
      const double square = square_of(error_of(problem.poses.at(k), pose_at(k)), covariances.independent.at(k));
      independent += square / (6.0 * kSeeds * (kKeyframes - 1));
      correlated += square / covariances.correlation_factor / (6.0 * kSeeds * (kKeyframes - 1));
    }
  }
  EXPECT_GT(independent, 4.0) << "ten times three quarters, and one";
  EXPECT_GT(correlated, 0.7);
  EXPECT_LT(correlated, 1.6);
}

TEST(KeyframeCovariances, AreTheSameSeenFromEitherEnd) {
  std::mt19937_64 random(3);
  const BundleProblem problem = chained_views(random);
  const Matrix6 there = keyframe_covariances(problem, {}, kCamera, 0).independent.at(kKeyframes - 1);
  const Matrix6 back = keyframe_covariances(problem, {}, kCamera, kKeyframes - 1).independent.at(0);
  EXPECT_LT((there - back).norm(), 1e-4 * there.norm());
}

TEST(KeyframeCovariances, GrowWithWhatIsRejected) {
  std::mt19937_64 random(3);
  const BundleProblem problem = chained_views(random);
  std::vector<std::size_t> half;
  for (std::size_t k = 0; k < problem.observations.size(); k += 2) half.push_back(k);
  const Matrix6 all = keyframe_covariances(problem, {}, kCamera, 0).independent.at(5);
  const Matrix6 less = keyframe_covariances(problem, half, kCamera, 0).independent.at(5);
  EXPECT_GT((less - all).ldlt().vectorD().minCoeff(), 0.0);
}

TEST(KeyframeCovariances, AreOfThoseThatSeeMostWhereTheyAreTooMany) {
  std::mt19937_64 random(3);
  const BundleProblem problem = chained_views(random);
  const auto all = keyframe_covariances(problem, {}, kCamera, 0).independent;
  const auto few = keyframe_covariances(problem, {}, kCamera, 0, 4).independent;
  ASSERT_EQ(few.size(), 4U);
  EXPECT_TRUE(few.contains(0));
  for (const auto& [id, covariance] : few) {
    EXPECT_GE((covariance - all.at(id)).trace(), 0.0) << id;  // fewer observations give a larger covariance
  }
}

TEST(KeyframeCovariances, SayNothingOfAKeyframeThatSharesNothing) {
  std::mt19937_64 random(3);
  BundleProblem problem = chained_views(random);
  problem.poses[99] = pose_at(0);
  problem.fixed[99] = false;
  const Matrix6 alone = keyframe_covariances(problem, {}, kCamera, 0).independent.at(99);
  EXPECT_NEAR(alone(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(alone(5, 5), 1e4, 1e-5);
}

TEST(KeyframeCovariances, OfAProblemWithoutPointsOrKeyframesAreNone) {
  EXPECT_TRUE(keyframe_covariances({}, {}, kCamera, 0).independent.empty());
  BundleProblem one;
  one.poses[0] = pose_at(0);
  EXPECT_EQ(keyframe_covariances(one, {}, kCamera, 0).independent.size(), 1U);
}

Map map_of(int keyframes) {
  Map map;
  Frame frame;
  for (int k = 0; k < keyframes; ++k) {
    frame.pose = pose_at(k);
    map.add_keyframe(frame, {});
  }
  return map;
}

TEST(ChainedCovariance, GoesByTheBestKeyframe) {
  Map map = map_of(4);
  map.keyframes.at(1).covariance = 4.0 * Matrix6::Identity();
  map.keyframes.at(2).covariance = 1.0 * Matrix6::Identity();
  chain_covariance(
      map, 3,
      {{{1, 0.25 * Matrix6::Identity()}, {2, 1.0 * Matrix6::Identity()}, {3, Matrix6::Zero()}, {77, Matrix6::Zero()}},
       2.0});
  EXPECT_EQ(map.keyframes.at(3).covariance, Matrix6(3.0 * Matrix6::Identity()));
  chain_covariance(map, 3, {});
  EXPECT_EQ(map.keyframes.at(3).covariance, Matrix6(3.0 * Matrix6::Identity()));
}

// An error zeta of a keyframe causes an error in every frame relative to it, with the rotated covariance.
TEST(FrameCovariance, IsTheKeyframesInTheFramesAxes) {
  const Map map = map_of(2);
  std::mt19937_64 random(1);
  const Vector3 turn = random_vector(random, 1e-5), move = random_vector(random, 1e-5);
  Vector6 zeta;
  zeta << turn, move;
  const Pose<frame::Camera, frame::Camera> T_frame_keyframe{rotation_exp({0.2, -0.3, 0.1}), {0.3, 0.1, -0.2}};
  const CameraFromTarget pose = T_frame_keyframe * map.pose_of(1);
  const CameraFromTarget moved =
      T_frame_keyframe * map.pose_of(1) * Pose<frame::Target, frame::Target>{rotation_exp(turn), move};
  const Vector6 delta = pose_difference(moved, pose);
  const Matrix6 outer = delta * delta.transpose();
  EXPECT_LT((turned(pose.R, zeta * zeta.transpose()) - outer).norm(), 1e-4 * outer.norm());
}

TEST(TrajectoryLog, AddsAKeyframesCovarianceToAFramesOwn) {
  Map map = map_of(2);
  const Vector6 spread(1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6);
  map.keyframes.at(1).covariance = spread.asDiagonal();
  const CameraFromTarget pose = pose_at(1);
  TrackedFrame frame;
  frame.placed = TrackedPose{pose, Matrix6::Zero(), 0.5};
  const Matrix6 own = 1e-6 * Matrix6::Ones() + 1e-6 * Matrix6::Identity();
  TrajectoryLog log;
  log.add(frame, 1, {}, own);
  const Matrix3 R_left_rectified = rotation_exp({0.02, -0.01, 0.03});
  const auto placed = log.frames(map, R_left_rectified).at(0).placed;
  ASSERT_TRUE(placed);
  const Matrix6 expected = turned(R_left_rectified, turned(pose.R, spread.asDiagonal()) + own);
  EXPECT_LT((placed->covariance - expected).norm(), 1e-6 * expected.norm());
  frame.keyframe = true;
  log.add(frame, 1, {}, own);
  const Matrix6 of_keyframe = turned(R_left_rectified, turned(pose.R, spread.asDiagonal()));
  EXPECT_LT((log.frames(map, R_left_rectified).at(1).placed->covariance - of_keyframe).norm(),
            1e-12 * of_keyframe.norm());
  map.keyframes.at(1).parent = 0;
  map.remove_keyframe(1);
  EXPECT_LT((log.frames(map, R_left_rectified).at(1).placed->covariance - of_keyframe).norm(),
            1e-12 * of_keyframe.norm())
      << "a keyframe that went is as uncertain as it was";
  EXPECT_EQ(placed->pose.t, R_left_rectified * pose.t);
  EXPECT_EQ(placed->rms_px, 0.5);
}

}  // namespace
}  // namespace pharos::slam
