// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/steady_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "host/vision/slam/final_adjustment.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

constexpr int kKeyframes = 24;
constexpr int kSeenBy = 6;  // keyframes in a row that see a point, so that errors add up; the first follow the last
constexpr double kStep_s = 0.4;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
// A turn in all.
const Vector3 kRate_rad_s = 6.283185307179586 / (kKeyframes * kStep_s) * Vector3(0.1, 0.97, -0.2).normalized();

using Motion = std::function<CameraFromTarget(double time_s)>;

// The body's place is no function of its attitude.
CameraFromTarget steadily_turned(double time_s) {
  return {rotation_exp(kRate_rad_s * time_s) * turned_pose(0.3).R,
          Vector3(0.02 * time_s, 0.1 * std::sin(time_s), 5.0 + 0.03 * std::cos(2.0 * time_s))};
}

// The same with a rotation in the camera's frame that is no part of a steady one.
Motion wobbling(double amplitude_deg) {
  return [amplitude_deg](double time_s) {
    CameraFromTarget pose = steadily_turned(time_s);
    const double wobble_rad = amplitude_deg * kDegree * std::sin(1.3 * time_s);
    pose.R = rotation_exp(Vector3(wobble_rad, 0.0, 0.0)) * pose.R;
    return pose;
  };
}

struct Turn {
  BundleProblem problem;
  std::map<KeyframeId, CameraFromTarget> truth;
  std::map<KeyframeId, double> times_s;
  std::vector<Vector3> points;
};

// One in `one_slides_of` points (0: none) slides over the body while it is seen about the y axis for a quarter of the
// turn.
Turn turn_of(const Motion& motion, double sigma_px, int one_slides_of, std::mt19937_64& random) {
  Turn out;
  out.points = random_points(random, 40 * kKeyframes);
  for (int k = 0; k < kKeyframes; ++k) {
    out.times_s[k] = 100.0 + kStep_s * k;
    out.truth[k] = motion(kStep_s * k);
    out.problem.poses[k] = out.truth[k];
    out.problem.fixed[k] = k == 0;
    out.problem.variance_factors[k] = 1.0;
    if (k == 0) continue;
    Vector6 error;
    error << random_vector(random, 0.002), random_vector(random, 0.005);
    out.problem.poses[k] = out.problem.poses[k].moved_by(error);
  }
  for (std::size_t p = 0; p < out.points.size(); ++p) {
    const auto id = static_cast<PointId>(p);
    const auto first = static_cast<int>(p % kKeyframes);
    const bool slides = one_slides_of > 0 && static_cast<int>(p) % one_slides_of == 0 && first < kKeyframes / 4;
    for (int step = 0; step < kSeenBy; ++step) {
      const KeyframeId k = (first + step) % kKeyframes;
      const Matrix3 slid = rotation_exp((slides ? 0.003 * step : 0.0) * Vector3::UnitY());
      Observation at = seen(slid * out.points[p], out.truth[k], sigma_px, random);
      if (sigma_px == 0.0) at.variance_px2 = 0.25;
      out.problem.observations.push_back({k, id, at});
    }
    out.problem.points[id] = out.points[p] + random_vector(random, 0.005);
  }
  return out;
}

double rmse_deg(const BundleProblem& solved, const Turn& turn) {
  double squares = 0.0;
  for (const auto& [id, pose] : solved.poses) {
    squares += std::pow(rotation_angle_between(pose.R, turn.truth.at(id).R) / kDegree, 2);
  }
  return std::sqrt(squares / kKeyframes);
}

FinalAdjustment adjusted_freely(const Turn& turn) {
  FinalAdjustment out;
  out.problem = turn.problem;
  out.rejected = adjust_bundle(out.problem, kCamera, 40);
  out.covariances = keyframe_covariances(out.problem, out.rejected, kCamera, 0);
  return out;
}

TEST(SteadyRotation, RecoversRatePosesAndPointsOfExactObservations) {
  std::mt19937_64 random(1);
  const Turn turn = turn_of(steadily_turned, 0.0, 0, random);
  BundleProblem solved = turn.problem;
  std::vector<std::size_t> rejected;
  const SteadyRotation rotation = adjust_steady_rotation(solved, turn.times_s, kCamera, 40, rejected);
  EXPECT_TRUE(rejected.empty());
  EXPECT_LT((rotation.rate_rad_s - kRate_rad_s).norm(), 1e-6);
  for (const auto& [id, pose] : solved.poses) {
    EXPECT_LT(rotation_angle_between(pose.R, turn.truth.at(id).R), 1e-5);
    EXPECT_LT((pose.t - turn.truth.at(id).t).norm(), 1e-4);
  }
  for (const auto& [id, point] : solved.points) {
    EXPECT_LT((point - turn.points[static_cast<std::size_t>(id)]).norm(), 1e-3);
  }
  EXPECT_EQ(solved.poses.at(0).R, turn.truth.at(0).R);
  EXPECT_EQ(solved.poses.at(0).t, turn.truth.at(0).t);
}

TEST(SteadyRotation, RejectsAFalseObservation) {
  std::mt19937_64 random(2);
  Turn turn = turn_of(steadily_turned, 0.0, 0, random);
  turn.problem.observations[70].seen.pixel.x() += 60.0;
  std::vector<std::size_t> rejected;
  adjust_steady_rotation(turn.problem, turn.times_s, kCamera, 40, rejected);
  EXPECT_EQ(rejected, std::vector<std::size_t>{70});
}

// They make free attitudes drift.
TEST(SteadyRotation, PointsThatSlideTurnItLess) {
  std::mt19937_64 random(3);
  const Turn turn = turn_of(steadily_turned, 0.4, 3, random);
  FinalAdjustment solution = adjusted_freely(turn);
  const double free_deg = rmse_deg(solution.problem, turn);
  EXPECT_GT(free_deg, 0.08);
  ASSERT_TRUE(take_steady_rotation(turn.times_s, kCamera, solution));
  EXPECT_LT(rmse_deg(solution.problem, turn), 0.5 * free_deg);
}

TEST(SteadyRotation, AnotherMotionContradictsItAndNothingIsChanged) {
  for (const double amplitude_deg : {0.5, 2.0, 10.0}) {
    std::mt19937_64 random(4);
    const Turn turn = turn_of(wobbling(amplitude_deg), 0.3, 0, random);
    const FinalAdjustment free = adjusted_freely(turn);
    FinalAdjustment solution = free;
    EXPECT_FALSE(take_steady_rotation(turn.times_s, kCamera, solution)) << amplitude_deg;
    EXPECT_EQ(solution.rejected, free.rejected);
    for (const auto& [id, pose] : free.problem.poses) {
      EXPECT_EQ(solution.problem.poses.at(id).R, pose.R);
      EXPECT_EQ(solution.problem.poses.at(id).t, pose.t);
      EXPECT_EQ(solution.covariances.independent.at(id), free.covariances.independent.at(id));
    }
  }
}

// Another rate in the second half; the times tell.
TEST(SteadyRotation, AChangedRateContradictsIt) {
  std::mt19937_64 random(5);
  const auto faster_later = [](double time_s) {
    CameraFromTarget pose = steadily_turned(time_s);
    pose.R = rotation_exp(0.03 * kRate_rad_s * std::max(0.0, time_s - 0.5 * kStep_s * kKeyframes)) * pose.R;
    return pose;
  };
  const Turn turn = turn_of(faster_later, 0.3, 0, random);
  FinalAdjustment solution = adjusted_freely(turn);
  EXPECT_FALSE(take_steady_rotation(turn.times_s, kCamera, solution));
}

// If it is false after all, what it moved is part of what is stated.
TEST(SteadyRotation, StatesWhatItMoves) {
  std::mt19937_64 random(3);
  const Turn turn = turn_of(steadily_turned, 0.4, 3, random);
  const FinalAdjustment free = adjusted_freely(turn);
  FinalAdjustment solution = free;
  ASSERT_TRUE(take_steady_rotation(turn.times_s, kCamera, solution));
  for (const auto& [id, pose] : solution.problem.poses) {
    const CameraFromTarget& before = free.problem.poses.at(id);
    EXPECT_EQ(solution.free.at(id).R, before.R);
    Vector6 moved;
    moved << rotation_log(before.R.transpose() * pose.R), before.R.transpose() * (pose.t - before.t);
    const double factor = free.covariances.correlation_factor;
    const Matrix6 stated = factor * solution.covariances.independent.at(id);
    const Matrix6 expected = factor * free.covariances.independent.at(id) + moved * moved.transpose();
    EXPECT_LT((stated - expected).norm(), 1e-12 + 1e-9 * expected.norm());
  }
}

// Smaller than any one attitude tells, 4.5 sigmas: all of them together do.
TEST(SteadyRotation, ASmallWobbleIsToldByTheCost) {
  std::mt19937_64 random(4);
  const Turn turn = turn_of(wobbling(0.15), 0.3, 0, random);
  FinalAdjustment solution = adjusted_freely(turn);
  BundleProblem steady = solution.problem;
  std::vector<std::size_t> rejected;
  adjust_steady_rotation(steady, turn.times_s, kCamera, 40, rejected);
  EXPECT_LT(max_deviation(solution.problem.poses, steady.poses, solution.covariances), kMaxSteadyDeviation);
  EXPECT_FALSE(take_steady_rotation(turn.times_s, kCamera, solution));
}

TEST(SteadyRotation, FewKeyframesAreNotTried) {
  std::mt19937_64 random(6);
  Turn turn = turn_of(steadily_turned, 0.3, 0, random);
  std::erase_if(turn.problem.observations, [](const BundleObservation& o) {
    return o.keyframe >= static_cast<KeyframeId>(kMinSteadyKeyframes) - 1;
  });
  std::erase_if(turn.problem.poses,
                [](const auto& pose) { return pose.first >= static_cast<KeyframeId>(kMinSteadyKeyframes) - 1; });
  FinalAdjustment solution = adjusted_freely(turn);
  EXPECT_FALSE(take_steady_rotation(turn.times_s, kCamera, solution));
}

TEST(SteadyRotation, GivesTheSameBitsTwice) {
  std::vector<Vector3> first;
  for (int run = 0; run < 2; ++run) {
    std::mt19937_64 random(7);
    Turn turn = turn_of(steadily_turned, 0.3, 4, random);
    std::vector<std::size_t> rejected;
    adjust_steady_rotation(turn.problem, turn.times_s, kCamera, 10, rejected);
    std::vector<Vector3> solved;
    for (const auto& [id, point] : turn.problem.points) solved.push_back(point);
    if (run == 0) first = solved;
    EXPECT_EQ(solved, first);
  }
}

}  // namespace
}  // namespace pharos::slam
