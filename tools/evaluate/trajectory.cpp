// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/trajectory.hpp"

#include <algorithm>

namespace pharos::evaluate {
namespace {

constexpr double kSameTime_s = 1e-9;

}  // namespace

template <class WorldFromBody>
std::optional<Moving<WorldFromBody>> pose_at(const Trajectory<WorldFromBody>& trajectory, double time_s,
                                             double max_gap_s) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), time_s - kSameTime_s,
                                      [](const auto& sample, double time) { return sample.time_s < time; });
  if (after == trajectory.end()) return std::nullopt;
  const bool at_sample = after->time_s <= time_s + kSameTime_s;
  if (after == trajectory.begin()) {
    return at_sample ? std::optional(Moving<WorldFromBody>{after->pose}) : std::nullopt;
  }
  const auto before = after - 1;
  const double gap_s = after->time_s - before->time_s;
  if (gap_s > max_gap_s) return at_sample ? std::optional(Moving<WorldFromBody>{after->pose}) : std::nullopt;
  const double fraction = (time_s - before->time_s) / gap_s;
  const Vector6 step = pose_difference(after->pose, before->pose);
  const Vector6 part = fraction * step;
  return Moving<WorldFromBody>{before->pose.moved_by(part), step.head<3>() / gap_s, step.tail<3>() / gap_s};
}

template <class WorldFromBody>
double median_interval_s(const Trajectory<WorldFromBody>& trajectory) {
  if (trajectory.size() < 2) return 0.0;
  std::vector<double> steps_s;
  steps_s.reserve(trajectory.size() - 1);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    steps_s.push_back(trajectory[i].time_s - trajectory[i - 1].time_s);
  }
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return *middle;
}

template std::optional<Moving<EstimatePose>> pose_at(const Trajectory<EstimatePose>&, double, double);
template std::optional<Moving<TruthPose>> pose_at(const Trajectory<TruthPose>&, double, double);
template double median_interval_s(const Trajectory<EstimatePose>&);
template double median_interval_s(const Trajectory<TruthPose>&);

}  // namespace pharos::evaluate
