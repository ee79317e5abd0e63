// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pharos::ellipse {
namespace {

constexpr double kNearFraction = 0.1;
constexpr double kRound = 0.9;
// Two contours nearer than this along half of their length cannot both have edges of their own after a filter of
// sigma = 1 px.
constexpr double kMinGap_px = 1.25;
constexpr int kPlaces = 32;

}  // namespace

bool similar(const Ellipse& one, const Ellipse& other) {
  const double minimum = std::min(one.b_px, other.b_px);
  if (std::abs(one.cx_px - other.cx_px) > kNearFraction * minimum ||
      std::abs(one.cy_px - other.cy_px) > kNearFraction * minimum)
    return false;
  if (std::abs(one.a_px - other.a_px) > kNearFraction * std::max(one.a_px, other.a_px)) return false;
  if (std::abs(one.b_px - other.b_px) > kNearFraction * std::max(one.b_px, other.b_px)) return false;
  if (one.b_px >= kRound * one.a_px && other.b_px >= kRound * other.a_px) return true;
  const double turn = std::abs(std::remainder(one.theta_rad - other.theta_rad, std::numbers::pi));
  return turn <= kNearFraction * std::numbers::pi;
}

bool same_ellipse(const DetectedEllipse& one, const DetectedEllipse& other) {
  if (!similar(one.ellipse, other.ellipse)) return false;
  const EllipseDistance distance(other.ellipse);
  int near = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double t = 2.0 * std::numbers::pi * k / kPlaces;
    if (std::abs(distance.px(point_at(one.ellipse, t))) < kMinGap_px) ++near;
  }
  return 2 * near >= kPlaces;
}

void add_to_clusters(const DetectedEllipse& ellipse, EllipseWorkspace& workspace) {
  auto& found = workspace.found;
  for (std::size_t k = found.size(); k-- > 0;) {
    if (!same_ellipse(ellipse, found[k])) continue;
    if (found[k].score >= ellipse.score) return;
    found.erase_unordered(k);
  }
  if (found.push_back(ellipse)) return;
  ++workspace.counters.ellipses_dropped;
  DetectedEllipse& worst = *std::min_element(
      found.begin(), found.end(), [](const DetectedEllipse& a, const DetectedEllipse& b) { return a.score < b.score; });
  if (worst.score < ellipse.score) worst = ellipse;
}

}  // namespace pharos::ellipse
