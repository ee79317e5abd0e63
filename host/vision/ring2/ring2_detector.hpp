// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/vision/ring2/ring_choice.hpp"
#include "host/vision/ring2/ring_hypothesis.hpp"
#include "pharos/base/image_view.hpp"
#include "pharos/ellipse/settings.hpp"
#include "pharos/ring2/solve.hpp"

namespace pharos::host {

/// What is looked for in a pair of images.
struct Ring2Settings {
  ellipse::EllipseSettings ellipses{.min_minor_px = 12.0, .min_proposal_points = 70};
  /// Deviation of an ellipse's edge that more points of it do not make smaller: lens, rim, light from one side.
  double systematic_px = 0.03;
  /// The same of a contour that was measured on the image where the model puts it: parts that shadows and other edges
  /// take differ from view to view. Over 60 random bodies errors are 0.6 (attitude) and 0.9 (position) of the sigmas
  /// with it.
  double edge_systematic_px = 0.10;
  /// What is told of the target; it decides between circles, and is no part of the fit.
  RingSizes sizes;
};

/// A pair's answer: circles, or the word for why there are none.
struct Ring2Detection {
  std::optional<ring2::Ring2Estimate> estimate;
  std::uint8_t one_edge = 0;  ///< OneEdge bits (rim.hpp): radii that may be those of an inner edge; their sigmas say so
  std::string refusal;  ///< left_black, right_saturated, left_no_ellipse, no_common_circle, left_right_exchanged, ...
  int edge_points = 0;  ///< that the answer rests on
  ring2::ContourSet contours;                                              ///< the ellipses that the answer rests on
  std::array<std::vector<ellipse::DetectedEllipse>, ring2::kViews> found;  ///< all that were detected
};

/// Ring and nozzle in a pair of images.
///
/// Ellipses of both images are matched by what they would be in space: a pair that is one circle before this rig, told
/// by its own fit. The ring is the largest of the circles that have a smaller one on their axis; the nozzle is that
/// one: of several (rims have two edges) the nearest to the cameras, and of these the largest. An ellipse that only one
/// image has is taken where it fits the other three. The two images are searched on two threads.
class Ring2Detector {
 public:
  /// Throws InputError for a rig that cannot measure.
  Ring2Detector(const ring2::Rig& rig, const Ring2Settings& settings);
  Ring2Detector(Ring2Detector&&) noexcept;
  Ring2Detector& operator=(Ring2Detector&&) noexcept;
  ~Ring2Detector();

  /// Throws InputError where an image has not its camera's size.
  Ring2Detection find(const Ring2Images& images);

  const ring2::Rig& rig() const { return rig_; }

 private:
  ring2::Rig rig_;
  Ring2Settings settings_;
  class View;
  std::array<std::unique_ptr<View>, ring2::kViews> views_;
};

/// The same from ellipses that were detected elsewhere.
Ring2Detection ring2_among(const ring2::Rig& rig, const Ring2Settings& settings,
                           std::array<std::vector<ellipse::DetectedEllipse>, ring2::kViews> found);

}  // namespace pharos::host
