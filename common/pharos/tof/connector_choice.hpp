// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/raised_box.hpp"
#include "pharos/tof/tof_settings.hpp"

namespace pharos::tof {

/// Connectors compared of one frame; satellites have two to four.
inline constexpr std::size_t kMaxConnectors = 8;

/// A raised box with a connector's shape.
struct SeenConnector {
  ConnectorFace face;
  bool sure = false;  ///< its edges were fitted

  double distance_m() const { return face.rectangle.centre_m.norm(); }
};
using SeenConnectors = StaticVector<SeenConnector, kMaxConnectors>;

/// Why no connector gives the turn.
enum class ConnectorDoubt : std::uint8_t {
  kNone,
  kNoneSeen,
  kMore,     ///< more are seen than the target carries
  kUnlike,   ///< not of one kind: one of them is none
  kUnclear,  ///< something nearer may be a connector, or a single one be none
  kHidden    ///< fewer are seen than the target carries, and an unmeasured place may hold a nearer one
};

struct ConnectorChoice {
  SeenConnectors seen;  ///< nearest first
  ConnectorDoubt doubt = ConnectorDoubt::kNoneSeen;
  /// Two are equally near: either may be the one.
  bool two_nearest = false;
};

/// The nearest connector (paper 000, 2.3), where it is certain to be the nearest.
///
/// `boxes` and grid as of find_raised_boxes. Where fewer are seen than `expected`, the others are farther away if every
/// nearer place was measured and is the plate's (odds of 10^4 to 1 a place); else there is no choice. Nor is there one
/// for a single box while something before the satellite hides as much of it as a connector takes, or of one told where
/// pixels do not show it as a rectangle: the box may be a cover. Nor where raised places were not looked at.
ConnectorChoice choose_connector(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                 const RingFit& ring, const ConnectorSettings& settings,
                                 const RaisedWorkspace& workspace);

}  // namespace pharos::tof
