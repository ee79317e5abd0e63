// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/combine.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <optional>
#include <span>

#include "pharos/ellipse/arc_pair.hpp"
#include "pharos/ellipse/checked_fit.hpp"
#include "pharos/ellipse/close_edges.hpp"
#include "pharos/ellipse/cluster.hpp"
#include "pharos/ellipse/contour_glance.hpp"
#include "pharos/ellipse/direct_fit.hpp"
#include "pharos/ellipse/near_edges.hpp"
#include "pharos/ellipse/refine_fit.hpp"
#include "pharos/ellipse/score.hpp"
#include "pharos/ellipse/support.hpp"

namespace pharos::ellipse {
namespace {

// A pair that turns by less together is not fitted.
constexpr float kMinTurnOfPair_rad = 1.0F;
// An arc that turns by more closes but for its ends: it is an ellipse of its own, no other's partner.
constexpr float kTurnOfWhole_rad = 5.5F;
// Maximum distance of a first fit from its own samples.
constexpr double kMaxFitRms_px = 1.0;
// Samples left out at an arc's two ends, in this order, where the whole arc does not fit. The one-sided ones for single
// arcs: an occluding edge continues the arc at one end.
struct Trim {
  std::size_t start, finish;
};
constexpr std::array<Trim, 4> kTrims = {{{0, 0}, {3, 3}, {5, 0}, {0, 5}}};
constexpr std::size_t kTrimsOfPairs = 2;
// Maximum distance of the arcs of one ellipse from their fit; of arcs with larger ones the best part is used.
constexpr double kGoodFitRms_px = 0.25;
// Before the blur's shift is undone a semi-axis is too small by 0.27 px at most (a disc of 3 px).
constexpr double kSeenMinor = 0.85;
// Edge points join a first fit within this distance, a refined one within less.
constexpr double kFirstGate_px = 2.0;
constexpr double kGate_px = 1.25;
// Best fits with one arc that are completed.
constexpr std::size_t kBestFits = 3;
// A first fit that scores less than this fraction of the threshold will not reach it by refinement, nor a refined one
// by another (285 accepted: at least 0.836 and 0.844). Nine of ten that are completed are rejected.
constexpr double kHope = 0.8;
constexpr double kHopeOfRefined = 0.84;
// Of a first fit's contour: without edges along so much of it at a glance it will not reach it either (of 7706 accepted
// ones the least has 0.39; of four others three are below).
constexpr double kMinAtGlance = 0.36;
// An arc of which this fraction lies on an accepted ellipse proposes no other.
constexpr double kExplained = 0.5;

// First and last samples that no trim leaves out.
constexpr std::array<std::size_t, 2> kFittedEnds = {5, kArcSamples - 6};
// What two samples may lie off a fit of two arcs by together, if its mean square is that of kMaxFitRms_px: 8 px by
// first order, which is half of the distance at least.
constexpr double kMaxOff_px = 16.0;
// A contour's length over its longer axis: perimeter_px() is least at b = a/9.
constexpr double kMinPerimeter = 2.09;

struct Candidate {
  Ellipse ellipse;
  double rank = 0.0;  // fraction of the contour covered by its arcs
};

class Combiner {
 public:
  Combiner(const EllipseSettings& settings, EllipseWorkspace& workspace) : settings_(settings), workspace_(workspace) {}

  void run() {
    for (std::size_t k = 0; k < arcs().size(); ++k) {
      if (arcs()[k].seed) order_[seeds_++] = static_cast<std::uint16_t>(k);
    }
    std::sort(
        order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(seeds_),
        [&](std::uint16_t a, std::uint16_t b) { return weight(a) > weight(b) || (weight(a) == weight(b) && a < b); });
    for (std::size_t k = 0; k < seeds_; ++k) propose(k);
  }

 private:
  const StaticVector<Arc, kMaxArcs>& arcs() const { return workspace_.arcs; }
  bool enough(std::uint32_t points) const { return points >= settings_.min_proposal_points; }
  float weight(std::uint16_t k) const {
    return static_cast<float>(arcs()[k].points()) * std::min(3.0F, std::abs(arcs()[k].turn_rad));
  }

  void propose(std::size_t position) {
    const std::uint16_t seed = order_[position];
    const Arc& arc = arcs()[seed];
    if (explained_[seed]) return;
    const bool whole = std::abs(arc.turn_rad) >= kTurnOfWhole_rad;
    if (whole && static_cast<double>(arc.radius_px) < kSeenMinor * settings_.min_minor_px) return;
    best_ = {};
    if (std::abs(arc.turn_rad) >= kMinTurnAlone_rad && enough(arc.points())) consider(arc, nullptr);
    if (!(whole && !best_.empty())) {
      for (std::size_t k = position + 1; k < seeds_; ++k) {
        const std::uint16_t other = order_[k];
        const Arc& partner = arcs()[other];
        if (explained_[other] || !enough(arc.points() + partner.points())) continue;
        if (std::abs(partner.turn_rad) >= kTurnOfWhole_rad) continue;
        if (std::abs(arc.turn_rad + partner.turn_rad) < kMinTurnOfPair_rad || !may_pair(arc, partner)) continue;
        if (!may_be_among_best(arc, partner)) continue;
        consider(arc, &partner);
      }
    }
    DetectedEllipse best;
    for (const Candidate& candidate : best_) {
      const std::optional<DetectedEllipse> found = complete(candidate.ellipse, arc.turn_rad < 0.0F);
      if (found && found->score > best.score) best = *found;
    }
    if (best.score < settings_.min_score) return;
    add_to_clusters(best, workspace_);
    mark_arcs_on(best.ellipse, best.bright_inside, kGate_px, kExplained, workspace_, explained_);
  }

  // Whether the fit to two arcs may rank above the last of the best: its contour is as long as the arcs are apart.
  bool may_be_among_best(const Arc& one, const Arc& other) const {
    if (!best_.full()) return true;
    float squared = 0.0F;
    for (const std::size_t i : kFittedEnds) {
      for (const std::size_t k : kFittedEnds) {
        const float u = one.samples[i].u - other.samples[k].u, v = one.samples[i].v - other.samples[k].v;
        squared = std::max(squared, u * u + v * v);
      }
    }
    const double length = one.points() + other.points();
    const double min_px = kMinPerimeter * (std::sqrt(static_cast<double>(squared)) - kMaxOff_px);
    return length > best_.back().rank * min_px;
  }

  // The fit to one arc or two, kept among the best. An arc may continue past its ellipse at its ends (a rounded
  // corner): where the whole arc does not fit, its middle is tried.
  void consider(const Arc& one, const Arc* other) {
    ++workspace_.counters.candidates;
    const double length = one.points() + (other == nullptr ? 0U : other->points());
    const bool alone = other == nullptr;
    std::optional<Ellipse> best;
    double best_squares = kMaxFitRms_px * kMaxFitRms_px;
    for (const Trim& trim : std::span(kTrims).first(alone ? kTrims.size() : kTrimsOfPairs)) {
      StaticVector<PointF, 2 * kArcSamples> points;
      for (const Arc* arc : {&one, other}) {
        if (arc == nullptr) continue;
        for (std::size_t k = trim.start; k < kArcSamples - trim.finish; ++k) points.push_back(arc->samples[k]);
      }
      const std::span<const PointF> fitted(points.data(), points.size());
      const std::optional<Ellipse> ellipse = fit_direct(fitted);
      if (!ellipse || !is_plausible(*ellipse, settings_, kSeenMinor)) continue;
      const double squares = mean_square_px2(*ellipse, fitted, best_squares);
      if (!(squares <= best_squares)) continue;
      best = ellipse;
      best_squares = squares;
      if (!alone || squares <= kGoodFitRms_px * kGoodFitRms_px) break;
    }
    if (best) insert({*best, length / perimeter_px(*best)});
  }

  // Or more than `most`, as soon as that is certain: most fits are rejected.
  static double mean_square_px2(const Ellipse& ellipse, std::span<const PointF> points, double maximum) {
    constexpr double kSure = 1.000001;  // beyond rounding
    const auto count = static_cast<double>(points.size());
    const EllipseDistance distance(ellipse);
    double squares = 0.0;
    for (const PointF& p : points) {
      squares += distance.squared_px2({static_cast<double>(p.u), static_cast<double>(p.v)});
      if (squares > kSure * maximum * count) break;
    }
    return squares / count;
  }

  void insert(const Candidate& candidate) {
    if (best_.full()) {
      if (best_.back().rank >= candidate.rank) return;
      best_.pop_back();
    }
    best_.push_back(candidate);
    for (std::size_t k = best_.size() - 1; k > 0 && best_[k - 1].rank < best_[k].rank; --k)
      std::swap(best_[k - 1], best_[k]);
  }

  std::optional<DetectedEllipse> complete(const Ellipse& start, bool bright_inside) {
    if (glance_along(start, bright_inside, workspace_) < kMinAtGlance) return std::nullopt;
    collect_support(start, bright_inside, kFirstGate_px, workspace_, support_);
    if (score_of(start, support_, settings_).value() < kHope * settings_.min_score) return std::nullopt;
    const std::uint32_t at_first = support_.count;
    std::optional<RefinedFit> fit = refit(start);
    if (!fit) return std::nullopt;
    collect_support(fit->ellipse, bright_inside, kGate_px, workspace_, support_);
    // The same points would give the same fit.
    if (support_.count != at_first) {
      if (score_of(fit->ellipse, support_, settings_).value() < kHopeOfRefined * settings_.min_score) {
        return std::nullopt;
      }
      fit = refit(fit->ellipse);
      if (!fit) return std::nullopt;
      collect_support(fit->ellipse, bright_inside, kGate_px, workspace_, support_);
    }
    const double rms_px = fit->rms_px;
    fit = checked_fit(*fit, support_, settings_, workspace_);
    if (!fit) return std::nullopt;
    DetectedEllipse found;
    found.ellipse = fit->ellipse;
    found.covariance = fit->covariance;
    found.score = score_of(fit->ellipse, support_, settings_).value();
    found.rms_px = rms_px;
    found.gradient = static_cast<float>(std::sqrt(support_.squared_gradient));
    found.coverage = support_.length_fraction;
    found.points = static_cast<std::int32_t>(support_.count);
    found.arcs = static_cast<std::int32_t>(support_.arcs);
    found.bright_inside = bright_inside;
    return found;
  }

  std::optional<RefinedFit> refit(const Ellipse& ellipse) {
    return refine_fit(ellipse, std::span<const PointF>(support_.points.data(), support_.points.size()),
                      support_.independent());
  }

  const EllipseSettings& settings_;
  EllipseWorkspace& workspace_;
  Support support_;
  StaticVector<Candidate, kBestFits> best_;
  std::array<std::uint16_t, kMaxArcs> order_{};  // of arcs that may propose, the heaviest first
  std::size_t seeds_ = 0;
  std::array<bool, kMaxArcs> explained_{};
};

}  // namespace

void combine_arcs(const EllipseSettings& settings, EllipseWorkspace& workspace) {
  workspace.found.clear();
  Combiner(settings, workspace).run();
  const std::bitset<kMaxEllipses> separated = separate_close_edges(workspace);
  for (std::size_t k = 0; k < workspace.found.size(); ++k) {
    if (!separated[k]) move_from_near_edges(workspace.found[k], workspace);
  }
  std::sort(workspace.found.begin(), workspace.found.end(),
            [](const DetectedEllipse& a, const DetectedEllipse& b) { return a.score > b.score; });
}

}  // namespace pharos::ellipse
