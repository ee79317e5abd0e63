// SPDX-License-Identifier: Apache-2.0
// Section 2.2.1 of paper 000: edges, arcs, ellipses.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "tools/tof/paper/paper_chain.hpp"

namespace pharos::tools::paper000 {
namespace {

// The paper prints T_1 = 2 alone; the others are ours.
constexpr double kMaxAxisRatio = 2.0;  // T_1
constexpr double kMaxTurn_rad = 0.7;   // T_theta
constexpr double kMinScore = 0.6;      // T_val
constexpr std::size_t kSample_px = 9;  // along an edge, for its turns
constexpr std::size_t kMinArc_px = 24;
constexpr double kMinSagitta = 0.04;  // of the chord: straighter ones are lines
constexpr double kJoin_px = 3.0;      // ends that are one arc
constexpr double kSame_px = 2.5;      // ellipses that are one
constexpr double kConcentric_px = 6.0;
constexpr double kMinSemiAxis_px = 12.0;

// Otsu's threshold of the gradients on the target: those of its outline against nothing would hide all others.
double gradient_threshold(const cv::Mat& grey, const cv::Mat& strength) {
  constexpr double kMinThreshold = 15.0;  // a foil's noise is below
  cv::Mat target;
  cv::erode(grey > 0, target, cv::getStructuringElement(cv::MORPH_RECT, {9, 9}));
  std::vector<std::uint8_t> values;
  for (int v = 0; v < grey.rows; ++v) {
    for (int u = 0; u < grey.cols; ++u) {
      if (target.at<std::uint8_t>(v, u) == 0) continue;
      values.push_back(cv::saturate_cast<std::uint8_t>(strength.at<float>(v, u)));
    }
  }
  if (values.empty()) return kMinThreshold;
  cv::Mat ignored;
  return std::max(kMinThreshold, cv::threshold(values, ignored, 0.0, 255.0, cv::THRESH_BINARY | cv::THRESH_OTSU));
}

cv::Mat edges_of(const ChainStages& stages) {
  const cv::Mat grey(stages.height_px, stages.width_px, CV_8U, const_cast<std::uint8_t*>(stages.grey.data()));
  cv::Mat smooth, gx, gy, strength, edges;
  cv::GaussianBlur(grey, smooth, {5, 5}, 1.2);
  cv::Sobel(smooth, gx, CV_32F, 1, 0);
  cv::Sobel(smooth, gy, CV_32F, 0, 1);
  cv::magnitude(gx, gy, strength);
  const double high = gradient_threshold(grey, strength);
  cv::Canny(smooth, edges, 0.5 * high, high, 3, true);
  return edges;
}

// Edge points in the order in which they follow each other; every pixel once.
std::vector<Arc> linked(cv::Mat edges) {
  const auto neighbour = [&edges](cv::Point at) -> std::optional<cv::Point> {
    for (const auto& [du, dv] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      const cv::Point next(at.x + du, at.y + dv);
      if (next.x < 0 || next.y < 0 || next.x >= edges.cols || next.y >= edges.rows) continue;
      if (edges.at<std::uint8_t>(next) != 0) return next;
    }
    return std::nullopt;
  };
  std::vector<Arc> arcs;
  for (int v = 0; v < edges.rows; ++v) {
    for (int u = 0; u < edges.cols; ++u) {
      if (edges.at<std::uint8_t>(v, u) == 0) continue;
      Arc arc;
      // From the first pixel to both sides.
      for (int side = 0; side < 2; ++side) {
        std::optional<cv::Point> at = side == 0 ? std::optional(cv::Point(u, v)) : neighbour({u, v});
        while (at) {
          edges.at<std::uint8_t>(*at) = 0;
          arc.emplace_back(at->x, at->y);
          at = neighbour(*at);
        }
        if (side == 0) std::reverse(arc.begin(), arc.end());
      }
      arcs.push_back(arc);
    }
  }
  return arcs;
}

// Step 3: arcs whose ends meet are one.
std::vector<Arc> joined(std::vector<Arc> arcs) {
  arcs.erase(std::remove_if(arcs.begin(), arcs.end(), [](const Arc& arc) { return arc.size() < kSample_px; }),
             arcs.end());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    for (std::size_t j = i + 1; j < arcs.size();) {
      Arc& one = arcs[i];
      Arc other = arcs[j];
      if ((one.front() - other.back()).norm() < kJoin_px || (one.front() - other.front()).norm() < kJoin_px) {
        std::reverse(one.begin(), one.end());
      }
      if ((one.back() - other.back()).norm() < kJoin_px) std::reverse(other.begin(), other.end());
      if ((one.back() - other.front()).norm() < kJoin_px) {
        one.insert(one.end(), other.begin(), other.end());
        arcs.erase(arcs.begin() + static_cast<std::ptrdiff_t>(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
  }
  return arcs;
}

double sagitta(const Arc& arc) {
  const Vector2 chord = arc.back() - arc.front();
  const Vector2 middle = arc[arc.size() / 2] - arc.front();
  const double length = chord.norm();
  return length < 1.0 ? 1.0 : std::abs(chord.x() * middle.y() - chord.y() * middle.x()) / (length * length);
}

// Step 4: at turning points, where the direction turns by more than T_theta or the curvature changes its sign.
std::vector<Arc> divided(const std::vector<Arc>& edges) {
  constexpr double kStraight_rad = 0.3;  // of the grid of pixels alone, over a sample: a smaller turn has no sign
  std::vector<Arc> arcs;
  for (const Arc& edge : edges) {
    std::vector<std::size_t> cuts = {0};
    double last = 0.0;
    for (std::size_t i = kSample_px; i + kSample_px < edge.size(); i += kSample_px) {
      const Vector2 before = edge[i] - edge[i - kSample_px], after = edge[i + kSample_px] - edge[i];
      const double turn = std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
      const bool opposite = std::abs(turn) > kStraight_rad && std::abs(last) > kStraight_rad && turn * last < 0.0;
      if (std::abs(turn) > kMaxTurn_rad || opposite) cuts.push_back(i);
      if (std::abs(turn) > kStraight_rad) last = turn;
    }
    cuts.push_back(edge.size());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      Arc arc(edge.begin() + static_cast<std::ptrdiff_t>(cuts[k]),
              edge.begin() + static_cast<std::ptrdiff_t>(cuts[k + 1]));
      if (arc.size() >= kMinArc_px && sagitta(arc) > kMinSagitta) arcs.push_back(std::move(arc));
    }
  }
  return arcs;
}

// The region constraint of figure 4: both arcs bulge away from each other (face to face).
bool face_to_face(const Arc& a, const Arc& b) {
  const Vector2 p1 = a[a.size() / 2], p2 = b[b.size() / 2];
  const Vector2 chord1 = 0.5 * (a.front() + a.back()), chord2 = 0.5 * (b.front() + b.back());
  return (chord1 - p1).dot(p2 - p1) > 0.0 && (chord2 - p2).dot(p1 - p2) > 0.0;
}

struct Fit {
  PaperEllipse ellipse;
  std::vector<const Arc*> arcs;
};

// Distance of a point from the ellipse, to first order.
double distance_px(const PaperEllipse& e, const Vector2& p) {
  const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
  const double x = (c * (p.x() - e.cx_px) + s * (p.y() - e.cy_px)) / e.a_px;
  const double y = (-s * (p.x() - e.cx_px) + c * (p.y() - e.cy_px)) / e.b_px;
  const double r = std::hypot(x, y);
  const double slope = std::hypot(x / e.a_px, y / e.b_px);
  return slope > 0.0 ? std::abs(r * r - 1.0) / (2.0 * slope) : e.b_px;
}

// The angle between the tangents at both ends of an arc, in degrees.
double tangents_deg(const Arc& arc) {
  double sum = 0.0;
  for (std::size_t i = kSample_px; i + kSample_px < arc.size(); i += kSample_px) {
    const Vector2 before = arc[i] - arc[i - kSample_px], after = arc[i + kSample_px] - arc[i];
    sum += std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
  }
  return std::abs(sum) * 180.0 / std::numbers::pi;
}

// (2), (3), (4).
double score_of(const Fit& fit) {
  const PaperEllipse& e = fit.ellipse;
  if (!(e.a_px / e.b_px < kMaxAxisRatio)) return 0.0;
  double exact = 0.0, turned_deg = 0.0;
  std::size_t points = 0;
  for (const Arc* arc : fit.arcs) {
    for (const Vector2& p : *arc) exact += 1.0 - 0.3 * distance_px(e, p);
    points += arc->size();
    turned_deg += tangents_deg(*arc);
  }
  const auto count = static_cast<double>(points);
  const double around = std::numbers::pi * (1.5 * (e.a_px + e.b_px) - std::sqrt(e.a_px * e.b_px));
  const double whole = 0.5 * count / around + 0.5 * turned_deg / 360.0;
  return exact <= 0.0 ? 0.0 : std::sqrt(exact / count * std::min(1.0, whole));
}

std::optional<Fit> fitted(const std::vector<const Arc*>& arcs) {
  std::vector<cv::Point2f> points;
  for (const Arc* arc : arcs) {
    for (const Vector2& p : *arc) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  if (points.size() < 6) return std::nullopt;
  const cv::RotatedRect box = cv::fitEllipseDirect(points);
  Fit fit;
  fit.arcs = arcs;
  PaperEllipse& e = fit.ellipse;
  e.cx_px = static_cast<double>(box.center.x);
  e.cy_px = static_cast<double>(box.center.y);
  e.a_px = 0.5 * static_cast<double>(box.size.width);
  e.b_px = 0.5 * static_cast<double>(box.size.height);
  e.theta_rad = static_cast<double>(box.angle) * std::numbers::pi / 180.0;
  if (e.a_px < e.b_px) {
    std::swap(e.a_px, e.b_px);
    e.theta_rad += 0.5 * std::numbers::pi;
  }
  if (!std::isfinite(e.a_px) || !std::isfinite(e.b_px) || e.b_px < kMinSemiAxis_px) return std::nullopt;
  e.score = score_of(fit);
  return fit;
}

bool same(const PaperEllipse& a, const PaperEllipse& b) {
  return std::hypot(a.cx_px - b.cx_px, a.cy_px - b.cy_px) < kSame_px && std::abs(a.a_px - b.a_px) < kSame_px &&
         std::abs(a.b_px - b.b_px) < kSame_px;
}

// Step 5, and arcs that agree with an ellipse join it, so that a contour in many pieces is one.
std::vector<Fit> combined(const std::vector<Arc>& arcs) {
  constexpr double kAgrees_px = 1.5;
  std::vector<Fit> fits;
  const auto grown = [&](std::vector<const Arc*> seed) {
    auto fit = fitted(seed);
    if (!fit) return;
    for (const Arc& arc : arcs) {
      if (std::find(seed.begin(), seed.end(), &arc) != seed.end()) continue;
      double sum = 0.0;
      for (const Vector2& p : arc) sum += distance_px(fit->ellipse, p);
      if (sum / static_cast<double>(arc.size()) < kAgrees_px) seed.push_back(&arc);
    }
    if (seed.size() > fit->arcs.size()) {
      if (auto more = fitted(seed)) fit = more;
    }
    fits.push_back(*fit);
  };
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    grown({&arcs[i]});
    for (std::size_t j = i + 1; j < arcs.size(); ++j) {
      if (face_to_face(arcs[i], arcs[j])) grown({&arcs[i], &arcs[j]});
    }
  }
  return fits;
}

}  // namespace

void find_ring(ChainStages& stages) {
  stages.edges = joined(linked(edges_of(stages)));
  stages.arcs = divided(stages.edges);
  constexpr std::size_t kMaxArcs = 40;  // the longest; every pair of them is tried
  std::sort(stages.arcs.begin(), stages.arcs.end(), [](const Arc& a, const Arc& b) { return a.size() > b.size(); });
  if (stages.arcs.size() > kMaxArcs) stages.arcs.resize(kMaxArcs);
  std::vector<Fit> fits = combined(stages.arcs);
  std::sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.ellipse.score > b.ellipse.score; });
  for (const Fit& fit : fits) {
    stages.fitted.push_back(fit.ellipse);
    if (fit.ellipse.score <= kMinScore) continue;
    const bool known = std::any_of(stages.accepted.begin(), stages.accepted.end(),
                                   [&](const PaperEllipse& one) { return same(one, fit.ellipse); });
    if (!known) stages.accepted.push_back(fit.ellipse);
  }
  // Outer and inner edge of the ring: the largest ellipse and the next within it. The nozzle is smaller.
  std::vector<PaperEllipse> by_size = stages.accepted;
  std::sort(by_size.begin(), by_size.end(),
            [](const PaperEllipse& a, const PaperEllipse& b) { return a.a_px > b.a_px; });
  for (std::size_t i = 1; i < by_size.size() && !stages.ring; ++i) {
    const PaperEllipse &outer = by_size[0], &inner = by_size[i];
    const bool centred = std::hypot(outer.cx_px - inner.cx_px, outer.cy_px - inner.cy_px) < kConcentric_px;
    if (centred && inner.a_px > 0.7 * outer.a_px) stages.ring = {outer, inner};
  }
}

}  // namespace pharos::tools::paper000
