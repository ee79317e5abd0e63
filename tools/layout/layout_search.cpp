// SPDX-License-Identifier: Apache-2.0
#include "tools/layout/layout_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace pharos::layout {
namespace {

constexpr double kGridSeats = 140.0;  // exchanges look at each for each sensor
constexpr double kLeastStep_m = 1e-4;
constexpr double kRounding_m = 1e-5;
constexpr int kMostExchanges = 12;
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

/// Corners, points along the sides (extremes are where precision comes from) and a grid inside.
std::vector<Vector2> seats_of(const std::vector<Vector2>& polygon, double step_m) {
  std::vector<Vector2> seats;
  Vector2 low = polygon.front();
  Vector2 high = polygon.front();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2 side = polygon[(i + 1) % polygon.size()] - p;
    const int parts = std::max(1, static_cast<int>(std::lround(side.norm() / step_m)));
    for (int k = 0; k < parts; ++k) seats.emplace_back(p + side * k / parts);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  const Vector2 middle = 0.5 * (low + high);
  const Vector2 half = 0.5 * (high - low) / step_m;
  for (int i = -static_cast<int>(half.x()); i <= static_cast<int>(half.x()); ++i) {
    for (int j = -static_cast<int>(half.y()); j <= static_cast<int>(half.y()); ++j) {
      const Vector2 seat = middle + step_m * Vector2(i, j);
      const bool inside = (nearest_within(polygon, seat) - seat).norm() == 0.0;
      const bool fresh = std::none_of(seats.begin(), seats.end(),
                                      [&](const Vector2& other) { return (other - seat).norm() < 0.5 * step_m; });
      if (inside && fresh) seats.push_back(seat);
    }
  }
  return seats;
}

}  // namespace

Target target_of(const ConvexBody& body, const Seats& seats) {
  Target target;
  for (std::size_t i = 0; i < seats.size(); ++i) {
    const Facet& facet = body.facets[seats[i].facet];
    SensorPlacement placement;
    placement.sensor = static_cast<std::uint8_t>(i);
    placement.position_m = (facet.at(seats[i].xy) / kRounding_m).array().round() * kRounding_m;
    placement.normal = facet.normal;
    target.push_back(placement);
  }
  return target;
}

std::vector<std::size_t> seen_facets(const ConvexBody& body, const std::vector<LighthouseFromBody>& poses,
                                     double incidence_rad) {
  const double least = std::cos(incidence_rad);
  const auto sees = [least](const Facet& facet, const LighthouseFromBody& pose) {
    return std::any_of(facet.corners.begin(), facet.corners.end(), [&](const Vector2& corner) {
      const Vector3 p = pose * facet.at(corner);
      return p.z() > 0.0 && (pose.R * facet.normal).dot(-p) > least * p.norm();
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
  step_m_ = std::max(std::sqrt(area / kGridSeats), kLeastStep_m);
  for (const std::size_t f : facets) {
    if (insets_[f].empty()) continue;
    for (const Vector2& xy : seats_of(insets_[f], step_m_)) grid_.push_back({f, xy});
  }
}

bool LayoutSearch::has_room(const Seats& seats, std::size_t except, const Seat& seat) const {
  const Vector3 p = body_.facets[seat.facet].at(seat.xy);
  for (std::size_t i = 0; i < seats.size(); ++i) {
    if (i == except) continue;
    const Vector3 other = body_.facets[seats[i].facet].at(seats[i].xy);
    if ((other - p).norm() < rules_.spacing_m) return false;
  }
  return true;
}

std::optional<Seats> LayoutSearch::spread() const {
  if (grid_.empty()) return std::nullopt;
  Seats seats{grid_.front()};
  std::vector<double> distance(grid_.size(), std::numeric_limits<double>::infinity());
  while (seats.size() < rules_.sensors) {
    const Vector3 last = body_.facets[seats.back().facet].at(seats.back().xy);
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      distance[i] = std::min(distance[i], (body_.facets[grid_[i].facet].at(grid_[i].xy) - last).norm());
    }
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest < rules_.spacing_m) return std::nullopt;
    seats.push_back(grid_[static_cast<std::size_t>(farthest - distance.begin())]);
  }
  return seats;
}

Seats LayoutSearch::scattered(std::uint64_t seed) const {
  Seats seats = *spread();
  std::mt19937_64 random(seed);
  // As many exchanges for any free seat as there are sensors, a few times over.
  for (std::size_t k = 0; k < 4 * seats.size(); ++k) {
    const Seat& seat = grid_[random() % grid_.size()];
    if (has_room(seats, k % seats.size(), seat)) seats[k % seats.size()] = seat;
  }
  return seats;
}

double LayoutSearch::exchange(Seats& seats, const Judge& judge, const std::function<void()>& tick) const {
  double best = judge(target_of(body_, seats));
  for (int round = 0; round < kMostExchanges; ++round) {
    const double before = best;
    for (std::size_t i = 0; i < seats.size(); ++i) {
      const Seat own = seats[i];
      Seat chosen = own;
      for (const Seat& seat : grid_) {
        if (!has_room(seats, i, seat)) continue;
        seats[i] = seat;
        const double score = judge(target_of(body_, seats));
        if (score < best - kWorthwhile) best = score, chosen = seat;
      }
      seats[i] = chosen;
      tick();
    }
    if (!(best < before)) break;
  }
  return best;
}

void LayoutSearch::polish(Seats& seats, const Judge& judge, const std::function<void()>& tick) const {
  double best = judge(target_of(body_, seats));
  double step_m = 0.5 * step_m_;
  while (step_m >= kLeastStep_m) {
    for (std::size_t i = 0; i < seats.size(); ++i) {
      for (const Vector2& way : {Vector2(1, 0), Vector2(-1, 0), Vector2(0, 1), Vector2(0, -1)}) {
        const Seat own = seats[i];
        const Seat moved{own.facet, nearest_within(insets_[own.facet], own.xy + step_m * way)};
        if (!has_room(seats, i, moved)) continue;
        seats[i] = moved;
        const double score = judge(target_of(body_, seats));
        if (score < best - kWorthwhile) {
          best = score;
        } else {
          seats[i] = own;
        }
      }
      tick();
    }
    step_m *= 0.5;
  }
}

Seats LayoutSearch::best(const Judge& judge, int starts, const std::function<void()>& tick) const {
  std::optional<Seats> best;
  double least = 0.0;
  for (int start = 0; start < starts; ++start) {
    Seats seats = start == 0 ? *spread() : scattered(seed_ + static_cast<std::uint64_t>(start));
    const double score = exchange(seats, judge, tick);
    if (!best || score < least) best = seats, least = score;
  }
  polish(*best, judge, tick);
  return *best;
}

}  // namespace pharos::layout
