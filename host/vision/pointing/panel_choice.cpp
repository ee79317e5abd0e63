// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/panel_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pharos::pointing {
namespace {

constexpr double kMinPanelLength_px = 14.0;
constexpr double kMinPanelFraction = 0.12;  // of the longest edge
// rad: perspective of a panel as wide as a half of its distance; what converges by accident is no rectangle in space.
constexpr double kMaxConvergence = 0.5;
constexpr double kMinOverlap = 0.55;  // of the shorter edge; a body may hide the rest
constexpr double kMinSeparation_px = 3.5;
constexpr double kMaxSeparation = 3.0;    // times the overlap: foreshortened panels
constexpr double kMinFill = 0.85;         // of the strip between the edges
constexpr double kWingTurn = 0.08;        // rad between the middle lines of a wing's panels
constexpr double kYokeOverlap_px = 10.0;  // of a yoke and its panel, whose corners are known to some pixels
constexpr double kWingOff = 0.35;         // of one's middle from the other's line, in separations

// Of the strip between two edges that converge, from one end of their overlap to the other.
double fraction_filled(const TargetMask& target, const Segment& first, const Segment& second) {
  constexpr int kAlong = 16, kAcross = 5;
  int inside = 0;
  for (int i = 0; i < kAlong; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const double along = (i + 0.5) / kAlong, across = 0.15 + 0.7 * (k + 0.5) / kAcross;
      const Vector2 place = (1.0 - across) * (first.begin + along * (first.end - first.begin)) +
                            across * (second.begin + along * (second.end - second.begin));
      inside += target.at(static_cast<std::int32_t>(std::lround(place.x())),
                          static_cast<std::int32_t>(std::lround(place.y())))
                    ? 1
                    : 0;
    }
  }
  return static_cast<double>(inside) / (kAlong * kAcross);
}

// Edges have the target on their positive side, so facing ones have opposite directions.
std::optional<EdgePair> pair_of(const Segment& a, const Segment& b, const TargetMask& target) {
  const double turn = std::acos(std::clamp(-a.along().dot(b.along()), -1.0, 1.0));
  if (turn > kMaxConvergence) return std::nullopt;
  const Segment back{b.end, b.begin};
  const Vector2 along = (a.along() + back.along()).normalized();
  const Vector2 across(-along.y(), along.x());
  const auto at = [&](const Vector2& place) { return along.dot(place - a.begin); };
  const double low = std::max(at(a.begin), at(back.begin)), high = std::min(at(a.end), at(back.end));
  const double overlap = high - low;
  if (overlap < kMinOverlap * std::min(a.length(), b.length())) return std::nullopt;
  const auto place_on = [&](const Segment& edge, double station) {
    const Vector2 d = edge.along();
    return Vector2(edge.begin + (station - at(edge.begin)) / along.dot(d) * d);
  };
  EdgePair pair{
      a, b, {0.5 * (place_on(a, low) + place_on(back, low)), 0.5 * (place_on(a, high) + place_on(back, high))}, 0.0};
  pair.separation = across.dot(place_on(back, 0.5 * (low + high)) - place_on(a, 0.5 * (low + high)));
  if (pair.separation < kMinSeparation_px || pair.separation > kMaxSeparation * overlap) return std::nullopt;
  const Segment ours{place_on(a, low), place_on(a, high)}, theirs{place_on(back, low), place_on(back, high)};
  if (fraction_filled(target, ours, theirs) < kMinFill) return std::nullopt;
  return pair;
}

bool same(const Segment& a, const Segment& b) { return a.begin == b.begin && a.end == b.end; }

}  // namespace

bool is_wing(const EdgePair& a, const EdgePair& b) {
  if (same(a.first, b.first) || same(a.first, b.second) || same(a.second, b.first) || same(a.second, b.second))
    return false;
  if (std::abs(a.middle.along().dot(b.middle.along())) < std::cos(kWingTurn)) return false;
  const double widths = a.separation / b.separation;
  if (widths > kWingWidths || widths < 1.0 / kWingWidths) return false;
  const double apart = (a.middle.middle() - b.middle.middle()).norm();
  if (apart < 0.5 * (a.middle.length() + b.middle.length())) return false;
  const double narrower = std::min(a.separation, b.separation);
  return std::abs(a.middle.offset(b.middle.middle())) < kWingOff * narrower &&
         std::abs(b.middle.offset(a.middle.middle())) < kWingOff * narrower;
}

bool is_yoke(const EdgePair& own, const EdgePair& other, const EdgePair& pair) {
  if (pair.separation < kWingWidths * own.separation || pair.middle.length() < own.middle.length()) return false;
  const Segment wing{other.middle.middle(), own.middle.middle()};
  const Vector2 place = pair.middle.middle();
  return std::abs(wing.along().dot(pair.middle.along())) > std::cos(kWingTurn) &&
         std::abs(wing.offset(place)) < kWingOff * pair.separation &&
         wing.station(place) > wing.length() + 0.5 * (own.middle.length() + pair.middle.length()) - kYokeOverlap_px;
}

std::vector<EdgePair> facing_pairs(const std::vector<Segment>& edges, const TargetMask& target) {
  std::vector<EdgePair> pairs;
  if (edges.empty()) return pairs;
  const double minimum = std::max(kMinPanelLength_px, kMinPanelFraction * edges.front().length());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t k = i + 1; k < edges.size(); ++k) {
      if (edges[i].length() < minimum || edges[k].length() < minimum) continue;
      if (const auto pair = pair_of(edges[i], edges[k], target)) pairs.push_back(*pair);
    }
  }
  return pairs;
}

}  // namespace pharos::pointing
