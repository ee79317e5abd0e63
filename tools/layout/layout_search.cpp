// SPDX-License-Identifier: Apache-2.0
#include "tools/layout/layout_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace pharos::layout {
namespace {

constexpr double kGridMountPoints = 140.0;  // exchanges try each of them for each sensor
constexpr double kMinStep_m = 1e-4;
constexpr double kRounding_m = 1e-5;
constexpr int kMaxExchanges = 12;
constexpr double kWorthwhile = 1e-6;

double area_of(const std::vector<Vector2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2& q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * twice;
}

/// Corners, points along the sides (precision is highest with sensors far apart) and a grid inside.
std::vector<Vector2> mount_points_of(const std::vector<Vector2>& polygon, double step_m) {
  std::vector<Vector2> mount_points;
  Vector2 low = polygon.front();
  Vector2 high = polygon.front();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2 side = polygon[(i + 1) % polygon.size()] - p;
    const int parts = std::max(1, static_cast<int>(std::lround(side.norm() / step_m)));
    for (int k = 0; k < parts; ++k) mount_points.emplace_back(p + side * k / parts);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const Vector2 middle = 0.5 * (low + high);
  const Vector2 half = 0.5 * (high - low) / step_m;
  for (int i = -static_cast<int>(half.x()); i <= static_cast<int>(half.x()); ++i) {
    for (int j = -static_cast<int>(half.y()); j <= static_cast<int>(half.y()); ++j) {
      const Vector2 mount_point = middle + step_m * Vector2(i, j);
      const bool inside = (nearest_within(polygon, mount_point) - mount_point).norm() == 0.0;
      const bool fresh = std::none_of(mount_points.begin(), mount_points.end(), [&](const Vector2& other) {
        return (other - mount_point).norm() < 0.5 * step_m;
      });
      if (inside && fresh) mount_points.push_back(mount_point);
    }
  }
  return mount_points;
}

}  // namespace

Target target_of(const ConvexBody& body, const MountPoints& mount_points) {
  Target target;
  for (std::size_t i = 0; i < mount_points.size(); ++i) {
    const Facet& facet = body.facets[mount_points[i].facet];
    SensorPlacement placement;
    placement.sensor = static_cast<std::uint8_t>(i);
    placement.position_m = (facet.at(mount_points[i].xy) / kRounding_m).array().round() * kRounding_m;
    placement.normal = facet.normal;
    target.push_back(placement);
  }
  return target;
}

std::vector<std::size_t> seen_facets(const ConvexBody& body, const std::vector<LighthouseFromBody>& poses,
                                     double incidence_rad) {
  const double minimum = std::cos(incidence_rad);
  const auto sees = [minimum](const Facet& facet, const LighthouseFromBody& pose) {
    return std::any_of(facet.corners.begin(), facet.corners.end(), [&](const Vector2& corner) {
      const Vector3 p = pose * facet.at(corner);
      return p.z() > 0.0 && (pose.R * facet.normal).dot(-p) > minimum * p.norm();
    });
  };
  std::vector<std::size_t> seen;
  for (std::size_t f = 0; f < body.facets.size(); ++f) {
    if (std::any_of(poses.begin(), poses.end(), [&](const auto& pose) { return sees(body.facets[f], pose); })) {
      seen.push_back(f);
    }
  }
  return seen;
}

LayoutSearch::LayoutSearch(const ConvexBody& body, const std::vector<std::size_t>& facets, Rules rules,
                           std::uint64_t seed)
    : body_(body), rules_(rules), seed_(seed), insets_(body.facets.size()) {
  double area = 0.0;
  for (const std::size_t f : facets) {
    insets_[f] = inset(body.facets[f].corners, rules.edge_m);
    area += area_of(insets_[f]);
  }
  step_m_ = std::max(std::sqrt(area / kGridMountPoints), kMinStep_m);
  for (const std::size_t f : facets) {
    if (insets_[f].empty()) continue;
    for (const Vector2& xy : mount_points_of(insets_[f], step_m_)) grid_.push_back({f, xy});
  }
}

bool LayoutSearch::has_room(const MountPoints& mount_points, std::size_t except, const MountPoint& mount_point) const {
  const Vector3 p = body_.facets[mount_point.facet].at(mount_point.xy);
  for (std::size_t i = 0; i < mount_points.size(); ++i) {
    if (i == except) continue;
    const Vector3 other = body_.facets[mount_points[i].facet].at(mount_points[i].xy);
    if ((other - p).norm() < rules_.spacing_m) return false;
  }
  return true;
}

std::optional<MountPoints> LayoutSearch::spread() const {
  if (grid_.empty()) return std::nullopt;
  MountPoints mount_points{grid_.front()};
  std::vector<double> distance(grid_.size(), std::numeric_limits<double>::infinity());
  while (mount_points.size() < rules_.sensors) {
    const Vector3 last = body_.facets[mount_points.back().facet].at(mount_points.back().xy);
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      distance[i] = std::min(distance[i], (body_.facets[grid_[i].facet].at(grid_[i].xy) - last).norm());
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest < rules_.spacing_m) return std::nullopt;
    mount_points.push_back(grid_[static_cast<std::size_t>(farthest - distance.begin())]);
  }
  return mount_points;
}

MountPoints LayoutSearch::scattered(std::uint64_t seed) const {
  MountPoints mount_points = *spread();
  std::mt19937_64 random(seed);
  // As many exchanges for any free seat as there are sensors, a few times over.
  for (std::size_t k = 0; k < 4 * mount_points.size(); ++k) {
    const MountPoint& mount_point = grid_[random() % grid_.size()];
    if (has_room(mount_points, k % mount_points.size(), mount_point))
      mount_points[k % mount_points.size()] = mount_point;
  }
  return mount_points;
}

double LayoutSearch::exchange(MountPoints& mount_points, const LayoutEvaluator& evaluator,
                              const std::function<void()>& tick) const {
  double best = evaluator(target_of(body_, mount_points));
  for (int round = 0; round < kMaxExchanges; ++round) {
    const double before = best;
    for (std::size_t i = 0; i < mount_points.size(); ++i) {
      const MountPoint own = mount_points[i];
      MountPoint chosen = own;
      for (const MountPoint& mount_point : grid_) {
        if (!has_room(mount_points, i, mount_point)) continue;
        mount_points[i] = mount_point;
        const double score = evaluator(target_of(body_, mount_points));
        if (score < best - kWorthwhile) best = score, chosen = mount_point;
      }
      mount_points[i] = chosen;
      tick();
    }
    if (!(best < before)) break;
  }
  return best;
}

void LayoutSearch::polish(MountPoints& mount_points, const LayoutEvaluator& evaluator,
                          const std::function<void()>& tick) const {
  double best = evaluator(target_of(body_, mount_points));
  double step_m = 0.5 * step_m_;
  while (step_m >= kMinStep_m) {
    for (std::size_t i = 0; i < mount_points.size(); ++i) {
      for (const Vector2& way : {Vector2(1, 0), Vector2(-1, 0), Vector2(0, 1), Vector2(0, -1)}) {
        const MountPoint own = mount_points[i];
        const MountPoint moved{own.facet, nearest_within(insets_[own.facet], own.xy + step_m * way)};
        if (!has_room(mount_points, i, moved)) continue;
        mount_points[i] = moved;
        const double score = evaluator(target_of(body_, mount_points));
        if (score < best - kWorthwhile) {
          best = score;
        } else {
          mount_points[i] = own;
        }
      }
      tick();
    }
    step_m *= 0.5;
  }
}

MountPoints LayoutSearch::best(const LayoutEvaluator& evaluator, int starts, const std::function<void()>& tick) const {
  std::optional<MountPoints> best;
  double minimum = 0.0;
  for (int start = 0; start < starts; ++start) {
    MountPoints mount_points = start == 0 ? *spread() : scattered(seed_ + static_cast<std::uint64_t>(start));
    const double score = exchange(mount_points, evaluator, tick);
    if (!best || score < minimum) best = mount_points, minimum = score;
  }
  polish(*best, evaluator, tick);
  return *best;
}

}  // namespace pharos::layout
