// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/bundle.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "host/vision/slam/bundle_solver.hpp"
#include "host/vision/slam/pose_blocks.hpp"
#include "host/vision/slam/reprojection_cost.hpp"

namespace pharos::slam {
namespace {

// Ceres orders eliminated blocks by address: they are in one array in the order of their numbers, else the same problem
// would be solved in a different order each time.
struct Blocks {
  explicit Blocks(const BundleProblem& problem) : numbers(7 * problem.poses.size() + 3 * problem.points.size()) {
    double* at = numbers.data();
    for (const auto& [id, pose] : problem.poses) {
      const PoseBlock block = block_of(pose);
      poses[id] = at;
      at = std::copy(block.begin(), block.end(), at);
    }
    for (const auto& [id, point] : problem.points) {
      points[id] = at;
      at = std::copy(point.data(), point.data() + 3, at);
    }
  }
  std::vector<double> numbers;
  std::map<KeyframeId, double*> poses;
  std::map<PointId, double*> points;
};

void solve(const BundleProblem& problem, Blocks& blocks, const StereoCamera& camera, int iterations,
           const std::vector<bool>& use) {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss loss(std::sqrt(kHuberChi2));
  PoseManifold manifold;
  ceres::Problem ceres(options);
  auto* ordering = new ceres::ParameterBlockOrdering;  // NOLINT(cppcoreguidelines-owning-memory): the solver owns it
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    const BundleObservation& observation = problem.observations[k];
    if (!use[k]) continue;
    // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
    ceres.AddResidualBlock(new Reprojection(observation.seen, camera), &loss, blocks.poses.at(observation.keyframe),
                           blocks.points.at(observation.point));
  }
  std::size_t moving = 0;
  for (const auto& [id, block] : blocks.poses) {
    if (!ceres.HasParameterBlock(block)) continue;
    ceres.SetManifold(block, &manifold);
    ordering->AddElementToGroup(block, 1);
    if (problem.fixed.at(id)) {
      ceres.SetParameterBlockConstant(block);
    } else {
      ++moving;
    }
  }
  for (const auto& [id, block] : blocks.points) {
    if (ceres.HasParameterBlock(block)) ordering->AddElementToGroup(block, 0);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(bundle_options(ordering, moving, iterations), &ceres, &summary);
}

bool is_in_front(const BundleObservation& observation, const Blocks& blocks) {
  return in_front(slam::pose_of(blocks.poses.at(observation.keyframe)), Vector3(blocks.points.at(observation.point)));
}

bool is_accepted(const BundleObservation& observation, const Blocks& blocks, const StereoCamera& camera) {
  return fits(observation.seen, Vector3(blocks.points.at(observation.point)),
              slam::pose_of(blocks.poses.at(observation.keyframe)), camera);
}

void add_observations(const Map& map, BundleProblem& problem, const std::set<KeyframeId>& moving) {
  for (auto& [id, position] : problem.points) {
    const MapPoint& point = map.points.at(id);
    position = point.position_m;
    for (const auto& [keyframe, feature] : point.seen_by) {
      const Keyframe& frame = map.keyframes.at(keyframe);
      const Feature& seen = frame.features[static_cast<std::size_t>(feature)];
      problem.poses[keyframe] = frame.pose;
      problem.variance_factors[keyframe] = frame.variance_factor;
      problem.fixed[keyframe] = !moving.contains(keyframe);
      problem.observations.push_back({keyframe, id, observation_of(seen, Vector3::Zero())});
    }
  }
}

}  // namespace

ceres::Solver::Options bundle_options(ceres::ParameterBlockOrdering* ordering, std::size_t moving_poses,
                                      int iterations) {
  ceres::Solver::Options options;
  options.linear_solver_ordering.reset(ordering);
  options.linear_solver_type = moving_poses <= 40 ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-5;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

bool in_front(const CameraFromTarget& pose, const Vector3& point_m) { return (pose * point_m).z() > kMinDepth_m; }

bool fits(const Observation& seen, const Vector3& point_m, const CameraFromTarget& pose, const StereoCamera& camera) {
  if (!in_front(pose, point_m)) return false;
  Observation at = seen;
  at.point_m = point_m;
  return residual_of(at, camera, pose).squaredNorm() / at.variance_px2 <= (at.stereo() ? kStereoChi2 : kMonoChi2);
}

BundleProblem local_problem(const Map& map, KeyframeId keyframe, std::size_t max_keyframes) {
  std::set<KeyframeId> moving{keyframe};
  for (const KeyframeId id : map.best_neighbours(keyframe, max_keyframes)) moving.insert(id);
  BundleProblem problem;
  for (const KeyframeId id : moving) {
    for (const PointId point : map.keyframes.at(id).points) {
      if (point != kNone) problem.points[point];
    }
  }
  moving.erase(map.keyframes.begin()->first);
  add_observations(map, problem, moving);
  return problem;
}

BundleProblem global_problem(const Map& map) {
  BundleProblem problem;
  std::set<KeyframeId> moving;
  for (const auto& [id, keyframe] : map.keyframes) moving.insert(id);
  moving.erase(map.keyframes.begin()->first);
  for (const auto& [id, point] : map.points) problem.points[id];
  add_observations(map, problem, moving);
  return problem;
}

std::vector<std::size_t> adjust_bundle(BundleProblem& problem, const StereoCamera& camera, int iterations) {
  Blocks blocks(problem);
  // A single point that starts behind a camera would make the adjustment fail at its first step.
  std::vector<bool> use;
  for (const BundleObservation& observation : problem.observations) use.push_back(is_in_front(observation, blocks));
  std::vector<std::size_t> rejected;
  solve(problem, blocks, camera, iterations, use);
  for (std::size_t k = 0; k < use.size(); ++k) {
    use[k] = is_accepted(problem.observations[k], blocks, camera);
  }
  solve(problem, blocks, camera, iterations, use);
  for (std::size_t k = 0; k < use.size(); ++k) {
    if (!use[k] && !is_accepted(problem.observations[k], blocks, camera)) rejected.push_back(k);
  }
  for (auto& [id, pose] : problem.poses) {
    if (!problem.fixed.at(id)) pose = slam::pose_of(blocks.poses.at(id));
  }
  for (auto& [id, point] : problem.points) point = Vector3(blocks.points.at(id));
  return rejected;
}

void apply(const BundleProblem& solved, const std::vector<std::size_t>& rejected, Map& map) {
  for (const auto& [id, pose] : solved.poses) {
    const auto at = map.keyframes.find(id);
    if (at != map.keyframes.end() && !solved.fixed.at(id)) at->second.pose = pose;
  }
  for (const auto& [id, position] : solved.points) {
    const auto at = map.points.find(id);
    if (at != map.points.end()) at->second.position_m = position;
  }
  for (const std::size_t k : rejected) {
    const BundleObservation& observation = solved.observations[k];
    if (map.points.contains(observation.point) && map.keyframes.contains(observation.keyframe)) {
      map.forget_observation(observation.point, observation.keyframe);
    }
  }
}

}  // namespace pharos::slam
