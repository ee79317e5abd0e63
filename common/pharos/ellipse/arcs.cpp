// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/ellipse/ellipse.hpp"
#include "pharos/ellipse/polygon.hpp"

namespace pharos::ellipse {
namespace {

constexpr float kPolygonTolerance_px = 0.7F;
// T_theta. Sides of the polygon of a circle of radius r bend by sqrt(8 * 0.7 / r): 43 deg at 10 px.
constexpr float kMaxBend_rad = 1.05F;
// Nearer vertices may be one corner.
constexpr float kRoundedCorner_px = 4.5F;
// A bend of the opposite sign below this is noise of the edge.
constexpr float kMinBend_rad = 0.06F;
// Shorter arcs support no ellipse, nor do straighter ones.
constexpr std::uint32_t kMinPoints = 8;
constexpr float kMinTurn_rad = 0.10F;
// Limits of an arc that may propose an ellipse.
constexpr std::uint32_t kMinSeedPoints = 12;
constexpr float kMinSeedTurn_rad = 0.35F;
// A contour closes where its ends are neighbours: the diagonal of a pixel, and half a pixel of each point's own offset.
constexpr float kClosed_px = 2.5F;
// A closed one turns once, but for the gap between its ends, where tangents are means of some points.
constexpr float kMinClosedTurn_rad = 1.2F * std::numbers::pi_v<float>;
constexpr float kMaxClosedTurn_rad = 2.4F * std::numbers::pi_v<float>;
// An open one that turns by less is not fitted alone.
constexpr float kMinOpenTurn_rad = 1.75F;
// The polygon of a smaller radius of curvature bends as corners do: sqrt(8 * 0.7 / 5.1) = 1.05, and a tenth for noise.
constexpr double kMinPolygonRadius_px = 5.6;
// Longer contours are left to the polygon, which is their only test: the samples of a whole one stand 16 px apart.
constexpr std::size_t kMaxWholePoints = 256;
// Maximum distance of a whole contour's samples from one ellipse: noise of edges, and a bow of the contour that the
// blur's shift makes on small ones. An occluded or angular contour is cut instead.
constexpr double kWholeRms_px = 0.35;
// Tangents at ends: mean of the gradients of so many points.
constexpr std::uint32_t kEndPoints = 4;

float angle_between(PointF a, PointF b) { return std::atan2(a.u * b.v - a.v * b.u, a.u * b.u + a.v * b.v); }

PointF unit(PointF p) {
  const float length = std::sqrt(p.u * p.u + p.v * p.v);
  return length > 0.0F ? PointF{p.u / length, p.v / length} : PointF{1.0F, 0.0F};
}

PointF place_of(const EdgePoint& p) { return {p.u_px, p.v_px}; }

PointF normal_of(const EdgePoint& p) {
  return unit({static_cast<float>(p.gradient_u), static_cast<float>(p.gradient_v)});
}

PointF side(std::span<const EdgePoint> points, std::uint16_t from, std::uint16_t to) {
  return {points[to].u_px - points[from].u_px, points[to].v_px - points[from].v_px};
}

// Direction of the contour over some points: their mean gradient rotated by +90 deg.
PointF tangent_of(std::span<const EdgePoint> points) {
  PointF sum;
  for (const EdgePoint& p : points) {
    const PointF normal = normal_of(p);
    sum.u -= normal.v;
    sum.v += normal.u;
  }
  return unit(sum);
}

// A circle around all points: the one around their bounds.
void bound(std::span<const EdgePoint> points, Arc& arc) {
  PointF low = place_of(points.front());
  PointF high = low;
  for (const EdgePoint& p : points) {
    low = {std::min(low.u, p.u_px), std::min(low.v, p.v_px)};
    high = {std::max(high.u, p.u_px), std::max(high.v, p.v_px)};
  }
  const float half_u = 0.5F * (high.u - low.u), half_v = 0.5F * (high.v - low.v);
  arc.about = {low.u + half_u, low.v + half_v};
  arc.radius_px = std::sqrt(half_u * half_u + half_v * half_v);
}

Arc make_arc(std::span<const EdgePoint> points, std::uint32_t begin) {
  Arc arc;
  arc.begin = begin;
  arc.end = begin + static_cast<std::uint32_t>(points.size());
  const std::size_t end_points = std::min<std::size_t>(kEndPoints, points.size());
  arc.start = place_of(points.front());
  arc.middle = place_of(points[points.size() / 2]);
  arc.finish = place_of(points.back());
  arc.start_tangent = tangent_of(points.first(end_points));
  arc.finish_tangent = tangent_of(points.last(end_points));
  for (std::size_t k = 0; k < kArcSamples; ++k) {
    const EdgePoint& p = points[k * (points.size() - 1) / (kArcSamples - 1)];
    arc.samples[k] = place_of(p);
    arc.normals[k] = normal_of(p);
  }
  bound(points, arc);
  // Between samples no arc turns by 180 deg: the sum unwraps whole turns.
  PointF direction = arc.start_tangent;
  for (std::size_t k = 0; k <= kArcSamples; ++k) {
    const PointF next = k < kArcSamples ? PointF{-arc.normals[k].v, arc.normals[k].u} : arc.finish_tangent;
    arc.turn_rad += angle_between(direction, next);
    direction = next;
  }
  return arc;
}

class ArcCutter {
 public:
  explicit ArcCutter(EllipseWorkspace& workspace) : workspace_(workspace) {}

  void cut(std::uint32_t begin, std::uint32_t end) {
    points_ = std::span<const EdgePoint>(workspace_.ordered.data() + begin, end - begin);
    offset_ = begin;
    if (keep_whole()) return;
    approximate_polygon(points_, kPolygonTolerance_px, vertices_);
    std::uint16_t arc_begin = 0;
    float before = 0.0F;
    for (std::size_t k = 1; k + 1 < vertices_.size(); ++k) {
      const std::uint16_t here = vertices_[k];
      const float bend = bend_at(k);
      if (is_corner(k, bend)) {
        keep(arc_begin, here);
        arc_begin = here;
        before = 0.0F;
        continue;
      }
      if (std::abs(bend) < kMinBend_rad) continue;
      if (bend_changes(before, bend)) {
        // At a point of the side between the two vertices: both arcs keep their own bend.
        const auto turn = static_cast<std::uint16_t>((vertices_[k - 1] + here) / 2);
        keep(arc_begin, turn);
        arc_begin = turn;
      }
      before = bend;
    }
    keep(arc_begin, vertices_.back());
  }

 private:
  float bend_at(std::size_t k) const {
    return angle_between(side(points_, vertices_[k - 1], vertices_[k]), side(points_, vertices_[k], vertices_[k + 1]));
  }
  // Blur rounds corners: their bend is then split over two vertices close together.
  bool is_corner(std::size_t k, float bend) const {
    if (std::abs(bend) > kMaxBend_rad) return true;
    const auto rounded = [&](std::size_t other) {
      if (other == 0 || other + 1 >= vertices_.size()) return false;
      const PointF between = side(points_, vertices_[k], vertices_[other]);
      return between.u * between.u + between.v * between.v < kRoundedCorner_px * kRoundedCorner_px &&
             std::abs(bend + bend_at(other)) > kMaxBend_rad;
    };
    return rounded(k - 1) || rounded(k + 1);
  }
  // A contour that is one ellipse is one arc, where it closes or where the polygon could not tell its tips from
  // corners.
  bool keep_whole() {
    if (points_.size() < kMinPoints || points_.size() > kMaxWholePoints) return false;
    const PointF gap = side(points_, static_cast<std::uint16_t>(points_.size() - 1), 0);
    const bool closed = gap.u * gap.u + gap.v * gap.v <= kClosed_px * kClosed_px;
    Arc arc = make_arc(points_, offset_);
    const float turn = std::abs(arc.turn_rad);
    if (turn < (closed ? kMinClosedTurn_rad : kMinOpenTurn_rad) || turn > kMaxClosedTurn_rad) return false;
    const std::optional<Ellipse> ellipse = fit_direct(arc.samples);
    if (!ellipse || !lies_on(*ellipse, arc)) return false;
    if (!closed && ellipse->b_px * ellipse->b_px > kMinPolygonRadius_px * ellipse->a_px) return false;
    arc.seed = true;
    store(arc);
    return true;
  }
  static bool lies_on(const Ellipse& ellipse, const Arc& arc) {
    const EllipseDistance distance(ellipse);
    double squares = 0.0;
    for (const PointF& p : arc.samples) {
      squares += distance.squared_px2({static_cast<double>(p.u), static_cast<double>(p.v)});
    }
    return squares <= kWholeRms_px * kWholeRms_px * kArcSamples;
  }
  void keep(std::uint16_t first, std::uint16_t last) {
    const std::uint32_t count = last + 1U - first;
    if (count < kMinPoints) return;
    Arc arc = make_arc(points_.subspan(first, count), offset_ + first);
    const float turn = std::abs(arc.turn_rad);
    if (turn < kMinTurn_rad) return;
    arc.seed = count >= kMinSeedPoints && turn >= kMinSeedTurn_rad;
    store(arc);
  }
  void store(const Arc& arc) {
    if (workspace_.arcs.push_back(arc)) return;
    ++workspace_.counters.arcs_dropped;
    Arc& shortest = *std::min_element(workspace_.arcs.begin(), workspace_.arcs.end(),
                                      [](const Arc& a, const Arc& b) { return a.points() < b.points(); });
    if (shortest.points() < arc.points()) shortest = arc;
  }

  EllipseWorkspace& workspace_;
  std::span<const EdgePoint> points_;
  std::uint32_t offset_ = 0;
  Vertices vertices_;
};

}  // namespace

void find_arcs(const Contours& contours, EllipseWorkspace& workspace) {
  workspace.arcs.clear();
  ArcCutter cutter(workspace);
  for (const Contour& contour : contours) {
    for (std::uint32_t begin = contour.begin; begin < contour.end; begin += kMaxPolygonPoints) {
      cutter.cut(begin, std::min(contour.end, begin + kMaxPolygonPoints));
    }
  }
  for (std::size_t k = 0; k < workspace.arcs.size(); ++k) {
    const Arc& arc = workspace.arcs[k];
    workspace.bounds.u_px[k] = arc.about.u;
    workspace.bounds.v_px[k] = arc.about.v;
    workspace.bounds.radius_px[k] = arc.radius_px;
  }
  workspace.counters.arcs = static_cast<std::uint32_t>(workspace.arcs.size());
}

}  // namespace pharos::ellipse
