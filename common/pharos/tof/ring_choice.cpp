// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/ring_choice.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/base/units.hpp"
#include "pharos/tof/ring_extent.hpp"

namespace pharos::tof {
namespace {

using ellipse::DetectedEllipse;
using ellipse::Ellipse;

// Narrower rings leave no pixel between their edges. A ring 3 px wide is detected up to a pixel narrower.
constexpr double kMinWidth_px = 1.5;
// Two circles of one plane have images of one shape but for perspective, a few per cent at these distances.
constexpr double kMaxShapeDifference = 0.12;
// Pairs checked and pairs measured: nested ellipses are few, and the right pair has the most pixels.
constexpr std::size_t kMaxPairs = 24;
constexpr std::size_t kMaxMeasured = 3;
// Ellipses whose partner is searched by depth where no pair was the ring.
constexpr std::size_t kMaxSingles = 12;
// Fraction of the pixels between the ellipses that must lie on the plane: less than the visible fraction of the ring,
// as a boom hides pixels of both.
constexpr double kMinInliers = 0.35;
// Scatter about the plane over that of the camera's noise at that range: beyond it there is no plane.
constexpr double kMaxScatter = 3.0;
// The same of the ring's face alone, without walls and mixed pixels; tilt darkens it by a third.
constexpr double kMaxFaceScatter = 1.8;
constexpr double kMinStepFraction = 0.6;
// Multipath in the ring and its walls' roundness, beyond noise.
constexpr double kPlaneMargin_m = 0.004;
// A ring's edges leave 0.05 to 0.35 px; where the base of the inner wall is taken for the inner edge, 0.8 and more.
constexpr double kMaxEdgeRms_px = 0.6;
// Chi-squared of three degrees of freedom that chance exceeds once in a million.
constexpr double kMaxDisagreement = 31.0;

struct Pair {
  const DetectedEllipse* outer = nullptr;
  const DetectedEllipse* inner = nullptr;
};

struct Candidate {
  std::array<Ellipse, 2> shape;  // by RingEdge
  PlaneFit plane;
  RingModel model;
  double merit = 0.0;
};

bool nested(const Ellipse& outer, const Ellipse& inner, const RingSettings& settings) {
  if (outer.b_px - inner.b_px < kMinWidth_px || outer.a_px - inner.a_px < kMinWidth_px) return false;
  const double ratio = inner.a_px / outer.a_px;
  if (ratio < settings.min_radius_ratio - 0.05 || ratio > settings.max_radius_ratio + 0.02) return false;
  if (std::fabs(inner.b_px / inner.a_px - outer.b_px / outer.a_px) > kMaxShapeDifference) return false;
  const double apart = std::hypot(outer.cx_px - inner.cx_px, outer.cy_px - inner.cy_px);
  return apart < outer.b_px - inner.b_px;
}

// Between read noise, which grows with the range's square, and shot noise, which grows with the range: the larger.
double expected_sigma_m(const DepthNoise& noise, double z) {
  const double ratio = z / noise.range_m;
  return noise.sigma_m * std::max(ratio, ratio * ratio);
}

// Fraction of the points beside the ring that lie behind its plane, of those with a result.
double step_fraction(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                     double radius_m, double min_step_m) {
  constexpr int kPlaces = 72;
  const PlaneAxes axes = axes_of(model.normal);
  const DepthPlane plane = model.plane();
  int behind = 0;
  int level = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = kTwoPi * k / kPlaces;
    const Vector3 place = model.centre_m + radius_m * (std::cos(angle) * axes.first + std::sin(angle) * axes.second);
    const auto pixel = project(camera.intrinsics, place);
    if (!pixel) continue;
    const auto u = static_cast<std::int32_t>(std::lround(pixel->x()));
    const auto v = static_cast<std::int32_t>(std::lround(pixel->y()));
    if (!frame.depth.contains(u, v)) continue;
    const std::uint16_t counts = frame.depth.at(u, v);
    if (!has_depth(counts)) {
      ++behind;  // empty space
      continue;
    }
    const double height = plane.height_m(rays.at(u, v), depth_z_m(camera, counts));
    if (height < -min_step_m) ++behind;
    if (std::fabs(height) <= min_step_m) ++level;  // occlusions before the ring do not count
  }
  return behind + level > 0 ? static_cast<double>(behind) / (behind + level) : 0.0;
}

bool inside_image(const PinholeCamera& camera, const RingModel& model) {
  constexpr int kPlaces = 36;
  const PlaneAxes axes = axes_of(model.normal);
  for (int k = 0; k < kPlaces; ++k) {
    const double angle = kTwoPi * k / kPlaces;
    const auto pixel = project(
        camera, model.centre_m + model.radius_m[0] * (std::cos(angle) * axes.first + std::sin(angle) * axes.second));
    if (!pixel || pixel->x() < 0.0 || pixel->y() < 0.0 || pixel->x() > camera.width_px - 1.0 ||
        pixel->y() > camera.height_px - 1.0) {
      return false;
    }
  }
  return true;
}

class RingSelector {
 public:
  RingSelector(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingSettings& settings,
               const DepthNoise& noise, RingFitWorkspace& workspace, TofStageListener* listener)
      : frame_(frame),
        camera_(camera),
        rays_(rays),
        settings_(settings),
        noise_(noise),
        workspace_(workspace),
        listener_(listener) {}

  Result<RingChoice, TofFailure> choose(std::span<const DetectedEllipse> ellipses) {
    if (ellipses.empty()) return TofFailure::kNoEllipses;
    find_pairs(ellipses);
    for (const Pair& pair : pairs_) {
      examine({pair.outer->ellipse, pair.inner->ellipse});
    }
    ended(TofStage::kPlane);
    RingChoice choice;
    if (measure_best(choice)) return choice;
    candidates_.clear();
    examine_singles(ellipses);
    ended(TofStage::kPlane);
    if (measure_best(choice)) return choice;
    return farthest_;
  }

 private:
  // Larger ones first, up to the limit: the ring is the largest circle on a satellite's face.
  void find_pairs(std::span<const DetectedEllipse> ellipses) {
    for (const DetectedEllipse& outer : ellipses) {
      for (const DetectedEllipse& inner : ellipses) {
        if (!nested(outer.ellipse, inner.ellipse, settings_)) continue;
        if (pairs_.full()) {
          if (pairs_.back().outer->ellipse.a_px >= outer.ellipse.a_px) continue;
          pairs_.pop_back();
        }
        pairs_.push_back({&outer, &inner});
        for (std::size_t i = pairs_.size() - 1;
             i > 0 && pairs_[i].outer->ellipse.a_px > pairs_[i - 1].outer->ellipse.a_px; --i) {
          std::swap(pairs_[i], pairs_[i - 1]);
        }
      }
    }
  }

  void failed(TofFailure why) { farthest_ = std::max(farthest_, why); }
  void ended(TofStage stage) const {
    if (listener_ != nullptr) listener_->ended(stage);
  }

  // Plane, size and step of the ring between two ellipses.
  void examine(const std::array<Ellipse, 2>& shape) {
    const Ellipse& outer = shape[index_of(RingEdge::kOuter)];
    const Ellipse& inner = shape[index_of(RingEdge::kInner)];
    const auto plane = fit_plane(frame_, camera_, rays_, ring_region(inner, outer));
    if (!plane || plane->inlier_fraction < kMinInliers) return failed(TofFailure::kNoRingPlane);
    const auto model = ring_on_plane(plane->plane, rays_, outer, inner);
    if (!model) return failed(TofFailure::kNoRingPlane);
    if (plane->rms_m > kMaxScatter * expected_sigma_m(noise_, model->centre_m.z()) + camera_.depth_scale_m) {
      return failed(TofFailure::kNoRingPlane);
    }
    if (!right_size(*model)) return failed(TofFailure::kRingSize);
    if (!stands_out(*model, *plane)) return failed(TofFailure::kNoStep);
    candidates_.push_back({shape, *plane, *model, plane->pixels * plane->inlier_fraction});
  }

  // Each of the largest ellipses as either of the ring's edges.
  void examine_singles(std::span<const DetectedEllipse> ellipses) {
    StaticVector<const DetectedEllipse*, kMaxSingles> singles;
    for (const DetectedEllipse& one : ellipses) {
      if (singles.full()) {
        if (singles.back()->ellipse.b_px >= one.ellipse.b_px) continue;
        singles.pop_back();
      }
      singles.push_back(&one);
      for (std::size_t i = singles.size() - 1; i > 0 && singles[i]->ellipse.b_px > singles[i - 1]->ellipse.b_px; --i) {
        std::swap(singles[i], singles[i - 1]);
      }
    }
    for (const DetectedEllipse* one : singles) {
      for (const RingEdge known : kRingEdges) examine_single(*one, known);
    }
  }

  void examine_single(const DetectedEllipse& one, RingEdge known) {
    const auto model = ring_from_one_edge(frame_, camera_, rays_, one.ellipse, known, settings_.min_radius_ratio);
    if (!model) return failed(TofFailure::kNoRingPlane);
    if (!right_size(*model)) return failed(TofFailure::kRingSize);
    const auto outer = image_of(*model, RingEdge::kOuter, camera_.intrinsics);
    const auto inner = image_of(*model, RingEdge::kInner, camera_.intrinsics);
    if (!outer || !inner) return failed(TofFailure::kRingLeavesImage);
    examine({*outer, *inner});
  }

  bool right_size(const RingModel& model) const {
    const double outer = model.radius_m[0];
    const double ratio = model.radius_m[1] / outer;
    return outer >= settings_.min_outer_radius_m && outer <= settings_.max_outer_radius_m &&
           ratio >= settings_.min_radius_ratio && ratio <= settings_.max_radius_ratio;
  }

  bool stands_out(const RingModel& model, const PlaneFit& plane) const {
    // Far enough from the edges that no pixel there is mixed with the ring's own.
    const double beside = 3.5 * model.centre_m.z() / camera_.intrinsics.fx_px / std::max(0.3, -model.normal.z());
    // One deviation: of painted circles' surroundings two of three are then level, of dark foil behind a far ring one
    // of twenty.
    const double step = std::max(settings_.min_step_m, plane.rms_m);
    return step_fraction(frame_, camera_, rays_, model, model.radius_m[0] + beside, step) >= kMinStepFraction &&
           step_fraction(frame_, camera_, rays_, model, model.radius_m[1] - beside, step) >= kMinStepFraction;
  }

  bool measure_best(RingChoice& choice) {
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return a.merit > b.merit; });
    bool measured = false;
    for (std::size_t i = 0; i < candidates_.size() && i < kMaxMeasured && !measured; ++i) {
      measured = measure(candidates_[i], choice);
    }
    ended(TofStage::kRing);
    return measured;
  }

  bool measure(const Candidate& candidate, RingChoice& choice) {
    if (!inside_image(camera_.intrinsics, candidate.model)) {
      failed(TofFailure::kRingLeavesImage);
      return false;
    }
    const auto fit = fit_from(candidate);
    if (!fit || fit->edge_rms_px > kMaxEdgeRms_px) {
      failed(TofFailure::kRingNotCircles);
      return false;
    }
    if (fit->seen < settings_.min_seen) {
      failed(TofFailure::kRingHidden);
      return false;
    }
    if (!right_size(fit->model)) {
      failed(TofFailure::kRingSize);
      return false;
    }
    if (fit->plane_chi2 > kMaxDisagreement) {
      failed(TofFailure::kRingInconsistent);
      return false;
    }
    choice = {candidate.shape[0], candidate.shape[1], *fit};
    return true;
  }

  // The ellipses may be those of a wall's base or of foil beside the ring: depths show where its face ends, and the
  // plane is that of the face alone.
  std::optional<RingFit> fit_from(const Candidate& candidate) {
    const auto model =
        ring_from_plane_extent(frame_, camera_, rays_, candidate.model, 3.0 * candidate.plane.rms_m + kPlaneMargin_m);
    if (!model) return std::nullopt;
    const auto outer = image_of(*model, RingEdge::kOuter, camera_.intrinsics);
    const auto inner = image_of(*model, RingEdge::kInner, camera_.intrinsics);
    if (!outer || !inner) return std::nullopt;
    const auto plane = fit_plane(frame_, camera_, rays_, ring_region(*inner, *outer));
    if (!plane ||
        plane->rms_m > kMaxFaceScatter * expected_sigma_m(noise_, model->centre_m.z()) + camera_.depth_scale_m) {
      return std::nullopt;
    }
    return fit_ring(frame_, camera_, rays_, *plane, *model, settings_.min_step_m, noise_, workspace_);
  }

  const TofFrame& frame_;
  const DepthCamera& camera_;
  const RayGrid& rays_;
  const RingSettings& settings_;
  const DepthNoise& noise_;
  RingFitWorkspace& workspace_;
  TofStageListener* listener_;
  StaticVector<Pair, kMaxPairs> pairs_;
  StaticVector<Candidate, kMaxPairs> candidates_;
  TofFailure farthest_ = TofFailure::kNoNestedPair;
};

}  // namespace

Result<RingChoice, TofFailure> choose_ring(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                           std::span<const DetectedEllipse> ellipses, const RingSettings& settings,
                                           const DepthNoise& noise, RingFitWorkspace& workspace,
                                           TofStageListener* listener) {
  return RingSelector(frame, camera, rays, settings, noise, workspace, listener).choose(ellipses);
}

}  // namespace pharos::tof
