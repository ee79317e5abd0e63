// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/raised_box.hpp"
#include "pharos/tof/target_description.hpp"

namespace pharos::tof {

/// A connector that was seen, and which of the description's it is taken for.
struct IdentifiedConnector {
  ConnectorFace face;
  std::size_t described = 0;
};

/// The target's turn by its description.
struct DescribedTurn {
  IdentifiedConnector best;
  /// Another turn that explains what is seen nearly as well, and by how much worse it does.
  std::optional<IdentifiedConnector> second;
  double delta_chi2 = 0.0;
};

/// Which turn puts the description's connectors where boxes stand.
///
/// Every box may be every connector of its distance from the ring's centre, height and size; that gives a turn. Its
/// likelihood: described connectors that stand at their places, of the same height and size, speak for it; places that
/// were measured and are the plate's speak against it; hidden ones say nothing. So a single connector gives the turn
/// where its distance and height are its own, or where the others' places tell. Nothing where no turn explains what is
/// seen.
std::optional<DescribedTurn> find_described_turn(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays,
                                                 const RingFit& ring, const TargetDescription& target,
                                                 const RaisedWorkspace& workspace);

}  // namespace pharos::tof
