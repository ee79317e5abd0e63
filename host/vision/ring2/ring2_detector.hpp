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

/// Settings of the search in a pair of images.
struct Ring2Settings {
  ellipse::EllipseSettings ellipses{.min_minor_px = 12.0, .min_proposal_points = 70};
  /// Standard deviation of a detected ellipse's edge that more points do not reduce: lens, rim, light from one side.
  double systematic_px = 0.03;
  /// The same for the weight of a contour that was measured where the model predicts it: shadows and other edges
  /// disturb different parts of it in each view. What the answer states is less: see EdgeContour.
  double edge_systematic_px = 0.10;
  /// Known sizes of the target; they decide between circles but are not used in the fit.
  RingSizes sizes;
};

/// Result for a pair: circles, or the reason for a refusal.
struct Ring2Detection {
  std::optional<ring2::Ring2Estimate> estimate;
  std::uint8_t one_edge =
      0;                ///< OneEdge bits (rim.hpp): radii that may be those of an inner edge; their sigmas include this
  std::string refusal;  ///< left_black, right_saturated, left_no_ellipse, no_common_circle, left_right_exchanged, ...
  int edge_points = 0;  ///< used in the estimate
  ring2::ContourSet contours;                                              ///< the ellipses used in the estimate
  std::array<std::vector<ellipse::DetectedEllipse>, ring2::kViews> found;  ///< all detected ellipses
};

/// Detects ring and nozzle in a pair of images.
///
/// Ellipses of both images propose hypotheses: one circle in space is the ring, another one on its axis the nozzle.
/// Each is refined on the edges of both images (follow_edges), and decide() chooses between them; if four ellipses give
/// none, hypotheses of three are tried. The ellipses are detected on two threads, one per image.
class Ring2Detector {
 public:
  /// Throws InputError for an invalid rig.
  Ring2Detector(const ring2::Rig& rig, const Ring2Settings& settings);
  Ring2Detector(Ring2Detector&&) noexcept;
  Ring2Detector& operator=(Ring2Detector&&) noexcept;
  ~Ring2Detector();

  /// Throws InputError if an image does not have its camera's size.
  Ring2Detection find(const Ring2Images& images);

  const ring2::Rig& rig() const { return rig_; }

 private:
  ring2::Rig rig_;
  Ring2Settings settings_;
  class View;
  std::array<std::unique_ptr<View>, ring2::kViews> views_;
};

/// Ring and nozzle from ellipses only, without images. Ellipses of both views are matched if they fit one circle in
/// space. The ring is the largest circle that has a smaller one on its axis. The nozzle is that one; of several (rims
/// have two edges) the nearest to the cameras, and of these the largest. An ellipse that only one view has is used if
/// it fits the other three.
Ring2Detection ring2_among(const ring2::Rig& rig, const Ring2Settings& settings,
                           std::array<std::vector<ellipse::DetectedEllipse>, ring2::kViews> found);

}  // namespace pharos::host
