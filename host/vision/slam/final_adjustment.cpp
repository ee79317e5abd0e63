// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/final_adjustment.hpp"

#include <utility>

namespace pharos::slam {
namespace {

constexpr int kSteps = 40;
// So many times further off at the start of the adjustment, a rotation that is not steady costs no adjustment.
constexpr double kMaxStartDeviation = 10.0 * kMaxSteadyDeviation;

KeyframePoses poses_on(const SteadyRotation& rotation, const std::map<KeyframeId, double>& times_s,
                       KeyframePoses poses) {
  for (auto& [id, pose] : poses) pose.R = rotation.R_at(times_s.at(id));
  return poses;
}

}  // namespace

bool take_steady_rotation(const std::map<KeyframeId, double>& times_s, const StereoCamera& camera,
                          FinalAdjustment& solution) {
  if (solution.problem.poses.size() < kMinSteadyKeyframes) return false;
  KeyframePoses free = solution.problem.poses;
  const KeyframePoses start = poses_on(mean_rotation(free, times_s), times_s, free);
  if (!(max_deviation(free, start, solution.covariances) <= kMaxStartDeviation)) return false;
  BundleProblem steady = solution.problem;
  std::vector<std::size_t> rejected;
  const SteadyRotation rotation = adjust_steady_rotation(steady, times_s, camera, kSteps, rejected);
  if (!(max_deviation(free, steady.poses, solution.covariances) <= kMaxSteadyDeviation)) return false;
  const double freedom = 3.0 * (static_cast<double>(free.size()) - 2.0);  // attitudes but the first, without the rate
  const double expected = freedom * solution.covariances.correlation_factor;
  if (!(rotation.cost_increase <= kMaxSteadyCostRatio * expected)) return false;
  add_deviations(free, steady.poses, solution.covariances);
  solution.problem = std::move(steady);
  solution.rejected = std::move(rejected);
  solution.steady = rotation;
  solution.free = std::move(free);
  return true;
}

FinalAdjustment adjust_finally(const Map& map, const StereoCamera& camera, bool try_steady) {
  FinalAdjustment out;
  out.problem = global_problem(map);
  out.rejected = adjust_bundle(out.problem, camera, kSteps);
  out.covariances = keyframe_covariances(out.problem, out.rejected, camera, map.keyframes.begin()->first);
  if (!try_steady) return out;
  std::map<KeyframeId, double> times_s;
  for (const auto& [id, keyframe] : map.keyframes) times_s[id] = keyframe.time_s;
  take_steady_rotation(times_s, camera, out);
  return out;
}

}  // namespace pharos::slam
