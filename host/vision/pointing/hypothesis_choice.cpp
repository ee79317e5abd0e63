// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/hypothesis_choice.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "host/vision/pointing/panel_evidence.hpp"

namespace pharos::pointing {
namespace {

// Pairs that are measured, the longest: a wing's four edges make four, a body's as many.
constexpr std::size_t kMaxPairs = 12;
// Nearer to the line of sight an axis is a matter of the panel's thickness.
constexpr double kMinFromSight_rad = 10.0 * kRadPerDeg;
// Of the best one's length: a shorter one is no rival.
constexpr double kRivalLength = 0.5;
constexpr double kOtherAxis_rad = 1.0 * kRadPerDeg;
// In the image, between the middle lines of a wing's panels: perspective draws them together in one line.
constexpr double kMaxTurnOfWing_rad = 0.15;

class Chooser {
 public:
  Chooser(ImageView<const std::uint16_t> image, const TargetMask& target, const PinholeCamera& camera,
          const std::vector<Segment>& outline, const std::vector<EdgePair>& pairs)
      : image_(image),
        target_(target),
        camera_(camera),
        outline_(outline),
        evidence_(image, target, camera, outline, pairs) {}

  void measure(std::vector<EdgePair> pairs) {
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const EdgePair& a, const EdgePair& b) { return a.middle.length() > b.middle.length(); });
    if (pairs.size() > kMaxPairs) pairs.resize(kMaxPairs);
    for (const EdgePair& pair : pairs) {
      const auto panel = measured_panel(image_, target_, camera_, pair, outline_);
      if (panel) {
        measured_.push_back({pair, *panel});
      } else if (!refusal_ || panel.error() == PointingRefusal::kCutByBorder) {
        refusal_ = panel.error();
      }
      if (!panel) (panel.error() == PointingRefusal::kCutByBorder ? cut_ : unsure_).push_back(pair);
    }
  }

  Result<PanelMeasurement, PointingRefusal> choice() {
    if (measured_.empty()) return *refusal_;
    std::vector<PanelHypothesis> hypotheses = all_hypotheses();
    std::stable_sort(hypotheses.begin(), hypotheses.end(),
                     [](const PanelHypothesis& a, const PanelHypothesis& b) { return a.score > b.score; });
    std::erase_if(hypotheses, [](const PanelHypothesis& h) { return is_contradicted(h); });
    const auto confirmed = std::find_if(hypotheses.begin(), hypotheses.end(), [&](const PanelHypothesis& h) {
      return !h.is_of_faces && evidence_.is_confirmed(h);
    });
    if (confirmed == hypotheses.end()) return cut_.empty() ? PointingRefusal::kNoPanel : PointingRefusal::kCutByBorder;
    PanelHypothesis& best = *confirmed;
    if (is_along_sight(best)) return PointingRefusal::kAlongSight;
    if (has_rival_of(cut_, kRivalLength, best) || is_of_a_longer(cut_, best)) return PointingRefusal::kCutByBorder;
    if (has_rival_of(unsure_, 1.0, best)) return PointingRefusal::kEdgeUnsure;
    add_alternative(hypotheses, best);
    if (!cut_.empty() && !best.is_wing()) best.measurement.flags |= kFlagPanelCut;
    return best.measurement;
  }

 private:
  std::vector<PanelHypothesis> all_hypotheses() const {
    std::vector<PanelHypothesis> all;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      for (std::size_t k = i + 1; k < measured_.size(); ++k) {
        const MeasuredPair &a = measured_[i], &b = measured_[k];
        if (is_of_faces(a.sides) || is_of_faces(b.sides) || !is_wing(a.pair, b.pair)) continue;
        if (auto wing = wing_of(a, b, camera_)) all.push_back(std::move(*wing));
      }
    }
    for (const MeasuredPair& one : measured_) {
      if (auto lone = lone_panel(one, camera_)) all.push_back(std::move(*lone));
    }
    return all;
  }

  // The first of its rivals, in `hypotheses` by score, that it does not outweigh.
  void add_alternative(const std::vector<PanelHypothesis>& hypotheses, PanelHypothesis& best) const {
    const bool in_line = evidence_.is_in_line(best);
    for (const PanelHypothesis& other : hypotheses) {
      if (!is_rival(best, other)) continue;
      // A body's outline is a rectangle as well, and a third edge may be an accident: alone they do not outweigh
      // another pair that nothing confirms, nor a longer one.
      const bool needs_proof = best.is_wing() || (in_line && other.score < best.score);
      if (needs_proof && (other.is_of_faces || !evidence_.is_confirmed(other))) continue;
      best.measurement.other_planes = other.measurement.long_planes;
      break;
    }
  }

  // A pair that the border cuts, or of which a side is no straight line, has no axis. Where it does not continue the
  // lone best one as a wing's other panel, it may be the panel instead.
  static bool has_rival_of(const std::vector<EdgePair>& pairs, double min_length, const PanelHypothesis& best) {
    // Its long sides in space may be the short ones in the image.
    return !best.is_wing() && std::any_of(pairs.begin(), pairs.end(), [&](const EdgePair& pair) {
      return pair.middle.length() > min_length * best.score &&
             std::abs(pair.middle.along().dot(best.sides[0].along())) < std::cos(kMaxTurnOfWing_rad);
    });
  }

  // An edge is one panel's: where it faces a longer one that is cut, what it faces besides is something else, a boom.
  static bool is_of_a_longer(const std::vector<EdgePair>& pairs, const PanelHypothesis& best) {
    const auto same = [](const Segment& a, const Segment& b) { return a.begin == b.begin && a.end == b.end; };
    const EdgePair& own = best.pairs.front();
    return !best.is_wing() && std::any_of(pairs.begin(), pairs.end(), [&](const EdgePair& pair) {
      return pair.middle.length() > own.middle.length() &&
             (same(pair.first, own.first) || same(pair.first, own.second) || same(pair.second, own.first) ||
              same(pair.second, own.second));
    });
  }

  bool is_along_sight(const PanelHypothesis& h) const {
    if (h.axis.sigma_rad() > kUnsureSigma_rad) return false;
    return angle_of(ray_of(h.pairs.front().middle.middle(), camera_), h.axis.axis) < kMinFromSight_rad;
  }

  static double longest_panel_px(const PanelHypothesis& h) {
    double longest = 0.0;
    for (const EdgePair& pair : h.pairs) longest = std::max(longest, pair.middle.length());
    return longest;
  }

  // Whether an axis is out of one of an edge's planes, which are known where the axis along them is not.
  static bool leaves(const AxisEstimate& axis, const AxisPlanes& planes) {
    return std::any_of(planes.begin(), planes.end(), [&](const AxisPlane& plane) {
      const double off = std::abs(std::asin(std::clamp(plane.normal.dot(axis.axis), -1.0, 1.0)));
      const double sigma =
          std::hypot(plane.sigma_rad(axis.axis), std::sqrt(plane.normal.dot(axis.covariance * plane.normal)));
      return off > std::max(kOtherAxis_rad, kMaxSigmas * sigma);
    });
  }

  static bool is_rival(const PanelHypothesis& best, const PanelHypothesis& other) {
    // Pieces of a body's two sides beside its wings are in line as a wing's panels are, and shorter than a panel of it.
    const double min_length =
        other.pairs.size() < best.pairs.size() ? longest_panel_px(best) : kRivalLength * best.score;
    if (other.score < min_length) return false;
    // An axis that is hardly known agrees with any other in the plane of its edges, which is known.
    if (other.axis.sigma_rad() > kUnsureSigma_rad) return !lies_in(other.measurement.long_planes, best.axis);
    if (best.axis.sigma_rad() > kUnsureSigma_rad) return !lies_in(best.measurement.long_planes, other.axis);
    const double sigma = std::hypot(best.axis.sigma_rad(), other.axis.sigma_rad());
    return angle_of(best.axis.axis, other.axis.axis) > std::max(kOtherAxis_rad, kMaxSigmas * sigma) ||
           leaves(best.axis, other.measurement.long_planes) || leaves(other.axis, best.measurement.long_planes);
  }

  ImageView<const std::uint16_t> image_;
  const TargetMask& target_;
  const PinholeCamera& camera_;
  const std::vector<Segment>& outline_;
  PanelEvidence evidence_;
  std::vector<MeasuredPair> measured_;
  std::optional<PointingRefusal> refusal_;
  std::vector<EdgePair> cut_;     // by the image's border
  std::vector<EdgePair> unsure_;  // not both sides are measured
};

}  // namespace

Result<PanelMeasurement, PointingRefusal> choose_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                                       const PinholeCamera& camera, const std::vector<Segment>& outline,
                                                       const std::vector<EdgePair>& pairs) {
  Chooser chooser(image, target, camera, outline, pairs);
  chooser.measure(pairs);
  return chooser.choice();
}

}  // namespace pharos::pointing
