// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/base/flag_word.hpp"
#include "pharos/base/result.hpp"
#include "pharos/ellipse/workspace.hpp"
#include "pharos/tof/connector.hpp"
#include "pharos/tof/connector_choice.hpp"
#include "pharos/tof/connector_edges.hpp"
#include "pharos/tof/frame_check.hpp"
#include "pharos/tof/ring_choice.hpp"
#include "pharos/tof/target_frame.hpp"
#include "pharos/tof/tof_settings.hpp"
#include "pharos/tof/tof_stages.hpp"

namespace pharos::tof {

/// Flags of a pose in addition to its covariance.
enum TofFlag : std::uint8_t {
  /// No reliable connector: the turn about Z' is unknown. Five degrees of freedom; the variance about Z' is that of a
  /// uniform angle.
  kFlagNoConnector = 1U << 0U,
  /// A tenth of the ring or more is hidden or has no depth.
  kFlagRingPartlyHidden = 1U << 1U,
  /// Fewer connectors than the target carries (ConnectorSettings::expected): the nearest may be missing. With
  /// kFlagNoConnector.
  kFlagFewConnectors = 1U << 2U,
  /// The connector's edges were not found: its position is that of its region.
  kFlagCoarseConnector = 1U << 3U,
  /// More connectors are seen than the target carries: which of them is none is not known. With kFlagNoConnector.
  kFlagMoreConnectors = 1U << 4U,
  /// The connectors seen are not of one kind, something nearer may be one, a single one of one told is not certainly a
  /// rectangle, or some of what stands on the plate was not looked at. With kFlagNoConnector.
  kFlagUnsureConnectors = 1U << 5U,
};
inline constexpr std::array<FlagWord, 6> kTofFlagWords = {{{kFlagNoConnector, "no_connector"},
                                                           {kFlagRingPartlyHidden, "ring_partly_hidden"},
                                                           {kFlagFewConnectors, "few_connectors"},
                                                           {kFlagCoarseConnector, "coarse_connector"},
                                                           {kFlagMoreConnectors, "more_connectors"},
                                                           {kFlagUnsureConnectors, "unsure_connectors"}}};

/// The measured pose of one frame, T_camera_target, and the measurements behind it.
struct TofPose {
  TargetPose target;
  /// Where two connectors are equally near, or two turns explain a target description: the pose by the other one.
  std::optional<TargetPose> second;
  double delta_chi2 = 0.0;  ///< by which the second explains the frame worse
  RingChoice ring;
  ConnectorFace connector;  ///< unless kFlagNoConnector
  SeenConnectors seen;      ///< nearest first; by a target description none
  std::uint8_t flags = 0;

  bool ambiguous() const { return second.has_value(); }
  bool has_turn() const { return (flags & kFlagNoConnector) == 0; }
};

/// All memory of the path except the stack, which needs some 80 KiB. Holds the last frame's rows and the lens' rays, so
/// one workspace belongs to one camera. After measure_tof_pose it holds intermediate results, for pictures:
/// ellipse.found, ellipse.arcs, connector.regions, edges.
struct TofWorkspace {
  TofWorkspace() : ellipse(planes) {}
  TofWorkspace(const TofWorkspace&) = delete;
  TofWorkspace& operator=(const TofWorkspace&) = delete;

  std::array<std::uint16_t, ellipse::kPlanes* static_cast<std::size_t>(kMaxPixels)> planes{};
  ellipse::EllipseWorkspace ellipse;
  FrameCheck frames;
  RayGrid rays;
  RingFitWorkspace edges;
  ConnectorWorkspace connector;
  RaisedWorkspace raised;
};
static_assert(sizeof(TofWorkspace) <= 8U * 1024U * 1024U, "fits the board's external memory");

/// The whole path (paper 000): ellipses in the intensity image, the docking ring by depth, connectors, target frame.
///
/// The error names what was missing; stage_of gives its stage. Every returned pose is finite, with a positive definite
/// covariance. Costs are in the README; `listener`, if any, is notified of each stage's end.
Result<TofPose, TofFailure> measure_tof_pose(const TofFrame& frame, const DepthCamera& camera,
                                             const TofSettings& settings, TofWorkspace& workspace,
                                             TofStageListener* listener = nullptr);

}  // namespace pharos::tof
