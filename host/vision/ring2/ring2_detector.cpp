// SPDX-License-Identifier: Apache-2.0
#include "host/vision/ring2/ring2_detector.hpp"

#include <algorithm>
#include <future>
#include <memory>

#include "host/support/input_error.hpp"
#include "host/vision/ring2/circle_match.hpp"
#include "host/vision/ring2/image_check.hpp"
#include "host/vision/ring2/rim.hpp"
#include "pharos/ellipse/detect.hpp"

namespace pharos::host {
namespace {

using ellipse::DetectedEllipse;
using ring2::Contour;
using ring2::Feature;

constexpr std::array<const char*, ring2::kViews> kViewNames{"left", "right"};
// Largest ellipses looked at of each image: a satellite shows ring and nozzle with two edges each and a few more.
constexpr std::size_t kMaxEllipses = 24;
// A lone ellipse that is to be the fourth must not make the worst contour worse than this.
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

// A contour that one image has and the other has not: the best fit among those that make a whole.
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

// One image's search, with memory that lasts: making and clearing it would cost a tenth of the search.
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
  return ring2_among(rig_, settings_, {std::move(views_[0]->found), std::move(views_[1]->found)});
}

}  // namespace pharos::host
