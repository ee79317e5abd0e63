// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/bundle.hpp"

#include <gtest/gtest.h>

#include "host/vision/slam/pose_graph.hpp"
#include "simulated_views.hpp"

namespace pharos::slam {
namespace {

using namespace test;

// Five keyframes that all see forty points.
Map simulated_map(std::mt19937_64& random, double sigma_px, std::vector<CameraFromTarget>& poses,
                  std::vector<Vector3>& points) {
  points = random_points(random, 40);
  std::vector<Descriptor> descriptors;
  for (std::size_t k = 0; k < points.size(); ++k) descriptors.push_back(descriptor_of(random));
  Map map;
  std::vector<PointId> ids;
  for (int k = 0; k < 5; ++k) {
    poses.push_back(turned_pose(0.08 * k));
    const KeyframeId id = map.add_keyframe(frame_of(points, descriptors, poses.back(), sigma_px, random), {}).id;
    for (std::size_t p = 0; p < points.size(); ++p) {
      if (k == 0) {
        ids.push_back(map.add_point(points[p], id, static_cast<int>(p)).id);
      } else {
        map.observe(ids[p], id, static_cast<int>(p));
      }
    }
    map.update_neighbours(id);
  }
  return map;
}

void move_all_but_the_first(Map& map, std::mt19937_64& random) {
  for (auto& [id, keyframe] : map.keyframes) {
    if (id == 0) continue;
    Vector6 error;
    error << random_vector(random, 0.01), random_vector(random, 0.03);
    keyframe.pose = keyframe.pose.moved_by(error);
  }
}

TEST(Bundle, RecoversPosesAndPointsOfExactObservations) {
  std::mt19937_64 random(1);
  std::vector<CameraFromTarget> poses;
  std::vector<Vector3> points;
  Map map = simulated_map(random, 0.0, poses, points);
  move_all_but_the_first(map, random);
  for (auto& [id, point] : map.points) point.position_m += random_vector(random, 0.02);
  BundleProblem problem = global_problem(map);
  EXPECT_TRUE(adjust_bundle(problem, kCamera, 30).empty());
  apply(problem, {}, map);
  for (const auto& [id, keyframe] : map.keyframes) {
    EXPECT_LT(rotation_angle_between(keyframe.pose.R, poses[static_cast<std::size_t>(id)].R), 1e-5);
    EXPECT_LT((keyframe.pose.t - poses[static_cast<std::size_t>(id)].t).norm(), 1e-4);
  }
  for (const auto& [id, point] : map.points) {
    EXPECT_LT((point.position_m - points[static_cast<std::size_t>(id)]).norm(), 1e-3);
  }
}

// One point that starts behind the cameras does not stop the adjustment of the others.
TEST(Bundle, APointBehindTheCamerasIsLeftOut) {
  std::mt19937_64 random(4);
  std::vector<CameraFromTarget> poses;
  std::vector<Vector3> points;
  Map map = simulated_map(random, 0.0, poses, points);
  move_all_but_the_first(map, random);
  map.points.at(7).position_m -= map.keyframes.at(2).pose.R.transpose() * Vector3(0.0, 0.0, 100.0);
  BundleProblem problem = global_problem(map);
  const auto rejected = adjust_bundle(problem, kCamera, 30);
  EXPECT_EQ(rejected.size(), poses.size());
  for (const std::size_t k : rejected) EXPECT_EQ(problem.observations[k].point, 7);
  apply(problem, rejected, map);
  EXPECT_FALSE(map.points.contains(7));
  for (const auto& [id, keyframe] : map.keyframes) {
    EXPECT_LT(rotation_angle_between(keyframe.pose.R, poses[static_cast<std::size_t>(id)].R), 1e-5);
  }
}

TEST(Bundle, RejectsAFalseObservationAndKeepsTheFixedPose) {
  std::mt19937_64 random(2);
  std::vector<CameraFromTarget> poses;
  std::vector<Vector3> points;
  Map map = simulated_map(random, 0.3, poses, points);
  map.keyframes.at(3).features[7].pixel.x() += 60.0;
  BundleProblem problem = global_problem(map);
  const auto rejected = adjust_bundle(problem, kCamera, 20);
  ASSERT_EQ(rejected.size(), 1U);
  EXPECT_EQ(problem.observations[rejected[0]].keyframe, 3);
  EXPECT_EQ(problem.observations[rejected[0]].point, 7);
  apply(problem, rejected, map);
  EXPECT_EQ(map.keyframes.at(3).points[7], kNone);
  EXPECT_FALSE(map.points.at(7).seen_by.contains(3));
  EXPECT_EQ(map.keyframes.at(0).pose.R, poses[0].R);
}

TEST(Bundle, GivesTheSameBitsTwice) {
  std::vector<Vector3> first;
  for (int run = 0; run < 2; ++run) {
    std::mt19937_64 random(3);
    std::vector<CameraFromTarget> poses;
    std::vector<Vector3> points, solved;
    const Map map = simulated_map(random, 0.5, poses, points);
    BundleProblem problem = local_problem(map, 4, 10);
    adjust_bundle(problem, kCamera, 10);
    for (const auto& [id, point] : problem.points) solved.push_back(point);
    if (run == 0) first = solved;
    EXPECT_EQ(solved, first);
  }
}

TEST(PoseGraph, SpreadsTheErrorOfARingOverAllOfIt) {
  // A turn of 24 steps, each a little too long: only the last edge shows it.
  constexpr int kSteps = 24;
  const double step = 2.0 * 3.14159265358979323846 / kSteps;
  const Vector6 drift = (Vector6() << 0.0, 0.004, 0.0, 0.002, 0.0, 0.001).finished();
  std::map<KeyframeId, CameraFromTarget> truth, poses;
  std::vector<PoseEdge> edges;
  for (int k = 0; k < kSteps; ++k) {
    truth[k] = turned_pose(0.0);
    truth[k].R = rotation_exp(Vector3(0.0, step * k, 0.0));
    poses[k] = truth[k];
    if (k == 0) continue;
    auto measured = truth.at(k) * truth.at(k - 1).inverse();
    measured = measured.moved_by(drift);
    edges.push_back({k, k - 1, measured});
    poses[k] = measured * poses.at(k - 1);
  }
  edges.push_back({kSteps - 1, 0, truth.at(kSteps - 1) * truth.at(0).inverse()});
  const double before = rotation_angle_between(poses.at(kSteps - 1).R, truth.at(kSteps - 1).R);
  adjust_pose_graph(poses, edges, {0});
  EXPECT_GT(before, 0.08);
  EXPECT_LT(rotation_angle_between(poses.at(kSteps - 1).R, truth.at(kSteps - 1).R), 0.1 * before);
  double worst = 0.0;
  for (int k = 0; k < kSteps; ++k) worst = std::max(worst, rotation_angle_between(poses.at(k).R, truth.at(k).R));
  EXPECT_LT(worst, 0.3 * before);
  EXPECT_EQ(poses.at(0).R, truth.at(0).R);
}

TEST(PoseGraph, LeavesConsistentEdgesAtZero) {
  std::map<KeyframeId, CameraFromTarget> poses{{0, turned_pose(0.0)}, {1, turned_pose(0.7)}, {2, turned_pose(1.9)}};
  const auto truth = poses;
  std::vector<PoseEdge> edges;
  for (const auto& [a, b] : {std::pair{1, 0}, {2, 1}, {2, 0}})
    edges.push_back({a, b, poses.at(a) * poses.at(b).inverse()});
  for (const PoseEdge& edge : edges) {
    EXPECT_LT(edge_residual(edge, poses.at(edge.from), poses.at(edge.to)).norm(), 1e-12);
  }
  poses[1] = poses[1].moved_by((Vector6() << 0.1, -0.05, 0.02, 0.1, 0.2, -0.1).finished());
  adjust_pose_graph(poses, edges, {0});
  EXPECT_LT(pose_difference(poses.at(1), truth.at(1)).norm(), 1e-6);
}

}  // namespace
}  // namespace pharos::slam
