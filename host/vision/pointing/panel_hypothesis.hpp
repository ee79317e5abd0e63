// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "host/vision/pointing/panel_choice.hpp"
#include "host/vision/pointing/panel_measurement.hpp"

namespace pharos::pointing {

/// A pair that was measured.
struct MeasuredPair {
  EdgePair pair;
  PanelSides sides;
};

/// That these pairs are the panel: one by itself, or the two panels of a wing.
struct PanelHypothesis {
  std::vector<EdgePair> pairs;
  PanelMeasurement measurement;
  AxisEstimate axis;               // in C
  double score = 0.0;              // px: length, more for a wing
  bool is_of_faces = false;        // no panel's, if its sides are measured right: it competes and is no answer
  bool has_unknown_end = false;    // see PanelSides
  bool has_slanted_end = false;    // at a corner of one side, not square to the sides in space
  bool has_outer_end = false;      // one of the whole ends is before the sky
  bool has_corner_end = false;     // an end is seen from one side only
  std::size_t whole_ends = 0;      // of the measurement's ends, the first: those that reach from side to side
  std::array<Segment, 2> sides{};  // of a lone pair: the long ones, in the image

  bool is_wing() const { return pairs.size() == 2; }
};

/// Of one pair; nothing where its sides are not longer than its ends in space, or where that is not known.
std::optional<PanelHypothesis> lone_panel(const MeasuredPair& one, const PinholeCamera& camera);

/// Of two in one line; nothing where the two together are not longer than wide.
std::optional<PanelHypothesis> wing_of(const MeasuredPair& a, const MeasuredPair& b, const PinholeCamera& camera);

/// Beyond chance, and beyond what lens and blur move edges by: ends that are not square to the sides, or sides of a
/// wing that are not parallel in space.
bool is_contradicted(const PanelHypothesis& h);

/// Whether the panel's two ends are seen, known well enough to have failed the test of right angles.
bool has_square_ends(const PanelHypothesis& h);

/// Whether every end meets both sides alike. A body's outline is cut at a corner by an edge of a third direction: its
/// opposite sides are of two faces, and the ends of one of them.
bool corners_close(const PanelHypothesis& h);

/// From here on such a test of an angle could not have failed.
inline constexpr double kMaxSquareSigma_rad = 3.0 * kRadPerDeg;
/// What counts as beyond chance.
inline constexpr double kMaxSigmas = 5.0;

/// Whether an edge's plane, or all of them, hold an axis.
bool lies_along(const AxisPlane& plane, const AxisEstimate& axis);
bool lies_in(const AxisPlanes& planes, const AxisEstimate& axis);

/// Between two axes, whichever way they point.
double angle_of(const Vector3& a, const Vector3& b);

}  // namespace pharos::pointing
