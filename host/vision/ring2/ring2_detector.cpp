// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring2_detector.hpp"

#include <algorithm>
#include <future>
#include <iterator>
#include <memory>
#include <utility>

#include "host/support/input_error.hpp"
#include "host/vision/ring2/circle_match.hpp"
#include "host/vision/ring2/image_check.hpp"
#include "host/vision/ring2/other_ring.hpp"
#include "host/vision/ring2/rim.hpp"
#include "host/vision/ring2/rim_evidence.hpp"
#include "host/vision/ring2/rings_before.hpp"
#include "pharos/ellipse/detect.hpp"

namespace pharos::host {
namespace {

using ellipse::DetectedEllipse;
using ring2::Contour;
using ring2::Feature;

constexpr std::array<const char*, ring2::kViews> kViewNames{"left", "right"};
// There are circles, but none is certainly the ring.
constexpr const char* kRingUnsure = "ring_unsure";
// Number of ellipses used of each image, the largest first: a satellite has two for the ring, two for the nozzle and a
// few more.
constexpr std::size_t kMaxEllipses = 24;
// Maximum residual of the fit with an ellipse that only one image has.
constexpr double kMaxRms_px = 0.5;

std::vector<DetectedEllipse> detected(ImageView<const std::uint16_t> image, const ellipse::EllipseSettings& settings,
                                      ellipse::EllipseWorkspace& workspace) {
  const std::span<const DetectedEllipse> found = ellipse::detect_ellipses(image, settings, workspace);
  std::vector<DetectedEllipse> ellipses(found.begin(), found.end());
  std::sort(ellipses.begin(), ellipses.end(),
            [](const auto& a, const auto& b) { return a.ellipse.a_px > b.ellipse.a_px; });
  ellipses.resize(std::min(ellipses.size(), kMaxEllipses));
  return ellipses;
}

// Adds the nozzle's contour if only one image has it: of the contours with a plausible nozzle, the one that fits best.
void add_lone(const ring2::Rig& rig, const std::array<std::vector<Contour>, ring2::kViews>& contours,
              ring2::ContourSet& chosen) {
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    std::optional<double> min_chi2;
    ring2::ContourSet best = chosen;
    for (const Contour& contour : contours[v]) {
      ring2::ContourSet with = chosen;
      with[v][static_cast<std::size_t>(Feature::kNozzle)] = contour;
      const auto fit = ring2::solve_ring2(rig, with);
      if (!fit || fit->rms_px > kMaxRms_px || fit->ambiguous()) continue;
      const bool like_a_nozzle =
          fit->nozzle_radius_m < 0.75 * fit->ring_radius_m && fit->distance_m > 0.1 * fit->ring_radius_m &&
          fit->distance_m < 3.0 * fit->ring_radius_m && fit->chi2 < 9.0 * fit->degrees_of_freedom;
      if (!like_a_nozzle || (min_chi2 && *min_chi2 <= fit->chi2)) continue;
      min_chi2 = fit->chi2;
      best = with;
    }
    if (min_chi2) {
      chosen = best;
      return;
    }
  }
}

std::array<std::vector<Contour>, ring2::kViews> contours_of(
    const std::array<std::vector<DetectedEllipse>, ring2::kViews>& found, double systematic_px) {
  std::array<std::vector<Contour>, ring2::kViews> contours;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    for (const DetectedEllipse& ellipse : found[v]) contours[v].push_back(ring2::contour_of(ellipse, systematic_px));
  }
  return contours;
}

ring2::ContourSet chosen_contours(const ring2::Rig& rig,
                                  const std::array<std::vector<Contour>, ring2::kViews>& contours) {
  const std::vector<MatchedCircle> circles = matched_circles(rig, contours);
  const RingAndNozzleChoice choice = choose_circles(circles);
  ring2::ContourSet chosen;
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    if (choice.ring != nullptr) chosen[v][0] = contours[v][choice.ring->index[v]];
    if (choice.nozzle != nullptr) chosen[v][1] = contours[v][choice.nozzle->index[v]];
  }
  if (choice.ring != nullptr && choice.nozzle == nullptr) add_lone(rig, contours, chosen);
  return chosen;
}

}  // namespace

Ring2Detection ring2_among(const ring2::Rig& rig, const Ring2Settings& settings,
                           std::array<std::vector<DetectedEllipse>, ring2::kViews> found) {
  Ring2Detection answer;
  answer.found = std::move(found);
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    if (!answer.found[v].empty()) continue;
    answer.refusal = std::string(kViewNames[v]) + "_no_ellipse";
    return answer;
  }
  const auto contours = contours_of(answer.found, settings.systematic_px);
  answer.contours = chosen_contours(rig, contours);
  if (!answer.contours[0][0]) {
    const ring2::ContourSet exchanged = chosen_contours(rig, {contours[1], contours[0]});
    answer.refusal = exchanged[0][0] ? name_of(ring2::Ring2Failure::kExchanged) : "no_common_circle";
    return answer;
  }
  const auto estimate = ring2::solve_ring2(rig, answer.contours);
  if (estimate) {
    answer.estimate = *estimate;
    answer.one_edge = settle_rims(rig, contours, *answer.estimate);
  } else {
    answer.refusal = name_of(estimate.error());
  }
  return answer;
}

namespace {

// Light and rims shift whole contours, which the scatter of edge points does not show. If there are enough contours,
// their disagreement shows it: the covariance is scaled by chi2 per degree of freedom.
ring2::Ring2Estimate with_scatter(ring2::Ring2Estimate estimate) {
  constexpr int kMinFreedom = 4;
  const double per_freedom = estimate.chi2 / std::max(1, estimate.degrees_of_freedom);
  // Above this value the estimator has already scaled it.
  if (estimate.degrees_of_freedom >= kMinFreedom && per_freedom > 1.0 && per_freedom <= ring2::kChancePerFreedom) {
    estimate.covariance *= per_freedom;
  }
  return estimate;
}

// A covariance whose tilts are about other axes of nearly the same plane.
ring2::Matrix8 covariance_about(const ring2::Matrix8& covariance, const std::array<Vector3, 2>& from,
                                const std::array<Vector3, 2>& to) {
  ring2::Matrix8 change = ring2::Matrix8::Identity();
  for (int i = 0; i < 2; ++i) {
    for (int k = 0; k < 2; ++k) {
      change(i, k) = to[static_cast<std::size_t>(i)].dot(from[static_cast<std::size_t>(k)]);
    }
  }
  return change * covariance * change.transpose();
}

bool is_size_told(const RingSizes& sizes) { return sizes.outer_radius || sizes.inner_radius; }

// The last rounds of following its edges, and its estimate.
std::optional<FollowedHypothesis> measured(const ring2::Rig& rig, const Ring2Settings& settings,
                                           const Ring2Images& images, RingHypothesis hypothesis) {
  if (!follow_edges(rig, images, settings.edge_systematic_px, FollowRounds::kLast, hypothesis)) return std::nullopt;
  auto estimate = ring2::solve_ring2(rig, hypothesis.contours);
  if (!estimate || estimate->unobservable != (hypothesis.has_nozzle ? 0 : ring2::kUnobservableNozzle)) {
    return std::nullopt;
  }
  if (const auto cautious = ring2::solve_ring2(rig, hypothesis.cautious)) {
    (*estimate).covariance = covariance_about(cautious->covariance, cautious->tilt_axes, estimate->tilt_axes);
  }
  const double rim = rim_evidence(rig, images, {estimate->ring_centre_m, estimate->normal, estimate->ring_radius_m});
  return FollowedHypothesis{std::move(hypothesis), with_scatter(*estimate), rim};
}

std::vector<FollowedHypothesis> followed(const ring2::Rig& rig, const Ring2Settings& settings,
                                         const Ring2Images& images, const std::vector<RingHypothesis>& hypotheses) {
  std::vector<RingHypothesis> near;
  for (RingHypothesis hypothesis : hypotheses) {
    if (!hypothesis.has_nozzle && !is_size_told(settings.sizes)) continue;  // it may be the nozzle instead
    if (!follow_edges(rig, images, settings.edge_systematic_px, FollowRounds::kFirst, hypothesis)) continue;
    const auto is_known = [&](const RingHypothesis& other) { return is_same(other, hypothesis); };
    if (std::none_of(near.begin(), near.end(), is_known)) near.push_back(std::move(hypothesis));
  }
  std::vector<FollowedHypothesis> result;
  for (RingHypothesis& hypothesis : near) {
    if (auto one = measured(rig, settings, images, std::move(hypothesis))) result.push_back(std::move(*one));
  }
  return result;
}

// Whether the images show another ring, of which no nozzle is seen, beside the chosen one.
bool follows_another_ring(const ring2::Rig& rig, const Ring2Settings& settings, const Ring2Images& images,
                          const std::vector<RingHypothesis>& hypotheses, const FollowedHypothesis& chosen) {
  return std::any_of(hypotheses.begin(), hypotheses.end(), [&](RingHypothesis other) {
    if (other.has_nozzle || !may_be_ring_beside(other.model, chosen.hypothesis.model)) return false;
    if (!follow_edges(rig, images, settings.edge_systematic_px, FollowRounds::kFirst, other)) return false;
    const auto ring = measured(rig, settings, images, std::move(other));
    return ring && is_ring_beside(*ring, chosen);
  });
}

void take(const ring2::Rig& rig, const RingDecision& decision, Ring2Detection& answer) {
  answer.contours = decision.best->hypothesis.contours;
  answer.edge_points = decision.best->hypothesis.edges;
  answer.estimate = decision.best->estimate;
  ring2::Ring2Estimate& estimate = *answer.estimate;
  // Where contours disagree by more than they state, all are worse: with_scatter.
  if (const auto stated = ring2::solve_ring2(rig, decision.best->hypothesis.stated)) {
    estimate.covariance = covariance_about(with_scatter(*stated).covariance, stated->tilt_axes, estimate.tilt_axes);
  }
  if (decision.rival != nullptr && !(estimate.second && estimate.second->delta_chi2 < decision.delta_chi2)) {
    const ring2::Ring2Estimate& rival = decision.rival->estimate;
    estimate.second = {rival.normal, rival.ring_centre_m, decision.delta_chi2};
  }
}

// The result of the images' edges; if there is none, the refusal by the ellipses.
Ring2Detection ring2_by_edges(const ring2::Rig& rig, const Ring2Settings& settings, const Ring2Images& images,
                              std::array<std::vector<DetectedEllipse>, ring2::kViews> found) {
  const auto contours = contours_of(found, settings.systematic_px);
  const std::vector<RingHypothesis> of_pairs = ring_hypotheses(rig, contours);
  for (const bool from_three : {false, true}) {
    std::vector<FollowedHypothesis> all =
        followed(rig, settings, images, from_three ? three_ellipse_hypotheses(rig, contours) : of_pairs);
    RingDecision decision = decide(rig, all, settings.sizes);
    if (decision.best == nullptr) continue;
    if (decision.best->hypothesis.has_nozzle) {
      auto before = followed(rig, settings, images, rings_before(rig, contours, decision.best->hypothesis.model));
      std::move(before.begin(), before.end(), std::back_inserter(all));
      decision = decide(rig, all, settings.sizes);
    }
    Ring2Detection answer;
    answer.found = std::move(found);
    if (decision.rival == nullptr && !is_size_told(settings.sizes) &&
        (shows_another_ring(rig, answer.found, decision.best->estimate) ||
         follows_another_ring(rig, settings, images, of_pairs, *decision.best))) {
      answer.refusal = kRingUnsure;
      return answer;
    }
    take(rig, decision, answer);
    answer.one_edge = settle_rims(rig, contours, *answer.estimate);
    return answer;
  }
  Ring2Detection answer = ring2_among(rig, settings, std::move(found));
  if (!answer.estimate) return answer;
  answer.estimate.reset();
  const ring2::ContourSet exchanged = chosen_contours(rig, {contours[1], contours[0]});
  const bool whole = exchanged[0][0] && exchanged[1][0] && exchanged[0][1] && exchanged[1][1];
  answer.refusal = whole && ring2::solve_ring2(rig, exchanged) ? name_of(ring2::Ring2Failure::kExchanged) : kRingUnsure;
  return answer;
}

}  // namespace

// The search in one image. It keeps its memory: allocating and clearing it each time would cost a tenth of the search.
class Ring2Detector::View {
 public:
  explicit View(const PinholeCamera& intrinsics)
      : planes_(ellipse::kPlanes * static_cast<std::size_t>(intrinsics.width_px) *
                static_cast<std::size_t>(intrinsics.height_px)),
        workspace_(planes_) {}

  void look(ImageView<const std::uint16_t> image, const ellipse::EllipseSettings& settings) {
    fault = fault_of(image);
    found.clear();
    if (fault == ImageDefect::kNone) found = detected(image, settings, workspace_);
  }

  ImageDefect fault = ImageDefect::kNone;
  std::vector<DetectedEllipse> found;

 private:
  std::vector<std::uint16_t> planes_;
  ellipse::EllipseWorkspace workspace_;
};

Ring2Detector::Ring2Detector(Ring2Detector&&) noexcept = default;
Ring2Detector& Ring2Detector::operator=(Ring2Detector&&) noexcept = default;
Ring2Detector::~Ring2Detector() = default;

Ring2Detector::Ring2Detector(const ring2::Rig& rig, const Ring2Settings& settings) : rig_(rig), settings_(settings) {
  switch (ring2::fault_of(rig)) {
    case ring2::RigFault::kNone:
      break;
    case ring2::RigFault::kIntrinsics:
      throw InputError("the rig: a camera has no usable optics; calibrate it");
    case ring2::RigFault::kRotation:
      throw InputError("the rig: a camera's rotation is none; calibrate it");
    case ring2::RigFault::kCamerasCoincide:
      throw InputError("the rig: both cameras stand in one place; give each its position");
  }
  for (std::size_t v = 0; v < ring2::kViews; ++v) views_[v] = std::make_unique<View>(rig.views[v].intrinsics);
}

Ring2Detection Ring2Detector::find(const Ring2Images& images) {
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    const PinholeCamera& intrinsics = rig_.views[v].intrinsics;
    if (images[v].width_px == intrinsics.width_px && images[v].height_px == intrinsics.height_px) continue;
    throw InputError(std::string("the ") + kViewNames[v] + " image is " + std::to_string(images[v].width_px) + " x " +
                     std::to_string(images[v].height_px) + " pixels, the rig's camera " +
                     std::to_string(intrinsics.width_px) + " x " + std::to_string(intrinsics.height_px) +
                     "; give the rig file of these cameras");
  }
  auto right = std::async(std::launch::async, [&] { views_[1]->look(images[1], settings_.ellipses); });
  views_[0]->look(images[0], settings_.ellipses);
  right.get();
  for (std::size_t v = 0; v < ring2::kViews; ++v) {
    if (views_[v]->fault == ImageDefect::kNone) continue;
    Ring2Detection answer;
    answer.refusal = std::string(kViewNames[v]) + '_' + name_of(views_[v]->fault);
    return answer;
  }
  return ring2_by_edges(rig_, settings_, images, {std::move(views_[0]->found), std::move(views_[1]->found)});
}

}  // namespace pharos::host
