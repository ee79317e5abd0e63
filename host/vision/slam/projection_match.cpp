// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/projection_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pharos::slam {
namespace {

constexpr int kBins = 12;

struct Best {
  int feature = -1, distance = 257, level = -1;
  int second = 257, second_level = -1;

  void offer(int index, int at_distance, int at_level) {
    if (at_distance < distance) {
      second = distance;
      second_level = level;
      feature = index;
      distance = at_distance;
      level = at_level;
    } else if (at_distance < second) {
      second = at_distance;
      second_level = at_level;
    }
  }
  bool clear(const ProjectionRules& rules) const {
    if (feature < 0 || distance > rules.max_distance) return false;
    return level != second_level || distance <= rules.ratio * second;
  }
};

// One candidate a feature: the best match is kept.
void one_each(std::vector<ProjectionMatch>& matches, std::size_t features) {
  std::vector<int> best(features, -1);
  for (std::size_t k = 0; k < matches.size(); ++k) {
    int& slot = best[static_cast<std::size_t>(matches[k].feature)];
    if (slot < 0 || matches[k].distance < matches[static_cast<std::size_t>(slot)].distance) slot = static_cast<int>(k);
  }
  std::vector<ProjectionMatch> kept;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (best[static_cast<std::size_t>(matches[k].feature)] == static_cast<int>(k)) kept.push_back(matches[k]);
  }
  matches = std::move(kept);
}

}  // namespace

void filter_by_orientation(std::vector<ProjectionMatch>& matches, const std::vector<double>& angle_differences_rad) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::array<int, kBins> counts{};
  std::vector<std::size_t> bins;
  for (const double difference : angle_differences_rad) {
    const double fraction = difference / kTurn - std::floor(difference / kTurn);
    bins.push_back(static_cast<std::size_t>(fraction * kBins + 0.5) % kBins);
    ++counts[bins.back()];
  }
  std::array<int, kBins> sorted = counts;
  std::sort(sorted.rbegin(), sorted.rend());
  const int minimum = std::max(sorted[2], (sorted[0] + 9) / 10);
  std::vector<ProjectionMatch> kept;
  for (std::size_t k = 0; k < matches.size(); ++k) {
    if (counts[bins[k]] >= minimum) kept.push_back(matches[k]);
  }
  matches = std::move(kept);
}

std::vector<ProjectionMatch> match_by_projection(const std::vector<Candidate>& candidates, const Frame& frame,
                                                 const std::vector<bool>& free, const StereoCamera& camera,
                                                 const CameraFromTarget& pose, const ProjectionRules& rules) {
  std::vector<ProjectionMatch> matches;
  std::vector<int> near;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Candidate& candidate = candidates[k];
    const Vector3 p = pose * candidate.position_m;
    if (p.z() <= 0.0) continue;
    const Vector3 place = camera.project(p);
    if (!(place.x() >= 0.0 && place.x() < camera.width_px && place.y() >= 0.0 && place.y() < camera.height_px))
      continue;
    const double radius = candidate.radius_px * scale_of(candidate.level);
    frame.grid.near(frame.features, place.head<2>(), radius, candidate.level - 1, candidate.level + 1, near);
    Best best;
    for (const int index : near) {
      const Feature& feature = frame.features[static_cast<std::size_t>(index)];
      if (!free.empty() && !free[static_cast<std::size_t>(index)]) continue;
      if (feature.stereo() && std::abs(feature.right_u_px - place.z()) > radius) continue;
      best.offer(index, distance(candidate.descriptor, feature.descriptor), feature.level);
    }
    if (best.clear(rules)) matches.push_back({static_cast<int>(k), best.feature, best.distance});
  }
  one_each(matches, frame.features.size());
  if (rules.check_orientation) {
    std::vector<double> turns;
    for (const ProjectionMatch& match : matches) {
      turns.push_back(frame.features[static_cast<std::size_t>(match.feature)].angle_rad -
                      candidates[static_cast<std::size_t>(match.candidate)].angle_rad);
    }
    filter_by_orientation(matches, turns);
  }
  return matches;
}

std::vector<ProjectionMatch> match_by_descriptor(const std::vector<Feature>& from, const std::vector<bool>& use_from,
                                                 const std::vector<Feature>& to, const std::vector<bool>& use_to,
                                                 double ratio) {
  std::vector<ProjectionMatch> matches;
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (!use_from.empty() && !use_from[k]) continue;
    int best = -1, minimum = 257, second = 257;
    for (std::size_t j = 0; j < to.size(); ++j) {
      if (!use_to.empty() && !use_to[j]) continue;
      const int d = distance(from[k].descriptor, to[j].descriptor);
      if (d < minimum) {
        second = minimum;
        minimum = d;
        best = static_cast<int>(j);
      } else if (d < second) {
        second = d;
      }
    }
    if (best >= 0 && minimum <= (kLowDistanceThreshold + kHighDistanceThreshold) / 2 && minimum <= ratio * second) {
      matches.push_back({static_cast<int>(k), best, minimum});
    }
  }
  one_each(matches, to.size());
  std::vector<double> turns;
  for (const ProjectionMatch& match : matches) {
    turns.push_back(to[static_cast<std::size_t>(match.feature)].angle_rad -
                    from[static_cast<std::size_t>(match.candidate)].angle_rad);
  }
  filter_by_orientation(matches, turns);
  return matches;
}

}  // namespace pharos::slam
