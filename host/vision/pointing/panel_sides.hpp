// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "host/vision/pointing/edge_points.hpp"
#include "host/vision/pointing/panel_choice.hpp"
#include "host/vision/pointing/pointing_refusal.hpp"
#include "host/vision/pointing/target_mask.hpp"
#include "pharos/base/result.hpp"
#include "pharos/pointing/line_fit.hpp"

namespace pharos::pointing {

/// One side of a panel: its points in the ideal image and the line through them.
struct Side {
  std::vector<pointing::EdgePoint> points;
  pointing::LineFit fit;
  Segment extent;  ///< in the image as it was taken
  double blur_px = 0.0;
  double contrast = 0.0;  ///< see MeasuredEdge
  double backing = 0.0;   ///< see MeasuredEdge
  std::optional<Backdrop> backdrop;
  double structure_px = 0.0;  ///< see MeasuredEdge
  bool cut = false;
};

/// A panel's long sides, and those of its ends that the sky stands behind.
struct PanelSides {
  Side first, second;
  std::vector<Side> ends;         ///< from one side to the other
  std::vector<Side> corner_ends;  ///< that begin at a corner of one side and are hidden before the other
  bool has_unknown_end = false;   ///< a side goes on to a corner, and the border cuts the edge there
};

/// Whether another face shows beyond one of the long sides: the pair is a body's, or a panel before one.
bool is_of_faces(const PanelSides& panel);

/// Whether another face in the dark shows behind an end, and not the sky that is behind a side.
bool is_before_a_face(const Side& end, const Side& side);

/// An edge of the outline as a side. kCutByBorder, kEdgeUnsure, kOutsideLens.
Result<Side, PointingRefusal> measured_side(ImageView<const std::uint16_t> image, const TargetMask& target,
                                            const PinholeCamera& camera, const Segment& guess, double reach_px);

/// A pair's edges measured on the grey image, and the ends between them.
Result<PanelSides, PointingRefusal> measured_panel(ImageView<const std::uint16_t> image, const TargetMask& target,
                                                   const PinholeCamera& camera, const EdgePair& pair,
                                                   const std::vector<Segment>& outline);

}  // namespace pharos::pointing
