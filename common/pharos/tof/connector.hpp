// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/connector_choice.hpp"
#include "pharos/tof/height_image.hpp"
#include "pharos/tof/local_threshold.hpp"
#include "pharos/tof/planar_rectangle.hpp"
#include "pharos/tof/regions.hpp"
#include "pharos/tof/ring_fit.hpp"

namespace pharos::tof {

/// Why a region of the depth image is not a connector; in the order of the checks.
enum class RegionVerdict : std::uint8_t { kConnector, kArea, kPlace, kAspect, kFill, kNotRaised };

/// A region found by the local threshold, and the results of the filters.
struct RegionReport {
  RegionVerdict verdict = RegionVerdict::kArea;
  std::int32_t area_px = 0;
  std::int32_t left = 0, top = 0, right = 0, bottom = 0;  ///< bounds in the frame, included
  double aspect = 0.0;
  double fill = 0.0;
  double height_m = 0.0;                 ///< of its face over the ring's plane
  double step_m = 0.0;                   ///< of its face over the median of its surroundings
  double distance_m = 0.0;               ///< of its centre from the ring's
  PlanarRectangle rectangle;             /// smallest rectangle around it
  Vector2 centroid_m = Vector2::Zero();  ///< in the rectangle's axes
  double area_m2 = 0.0;
};

/// Maximum number of regions reported of one frame, the first found; beyond that only connectors are kept.
inline constexpr std::size_t kMaxRegions = 48;

struct ConnectorWorkspace {
  std::array<std::uint16_t, static_cast<std::size_t>(kMaxPixels)> heights;
  ThresholdWorkspace threshold;
  BitImage mask;   /// of `rect`: pixels above the threshold (5)
  BitImage faces;  /// pixels above half the step of their region
  BitImage scratch;
  RegionWorkspace growing;
  Region region;
  PixelRect rect;  ///< of the frame that was searched
  StaticVector<RegionReport, kMaxRegions> regions;
  StaticVector<RegionReport, kMaxConnectors> connectors;
};

/// The paper's way (2.2.2), for comparison; poses take what find_raised_boxes finds. Regions that stand over their
/// surroundings like a connector: heights over the ring's plane,
/// local threshold (5), morphology, region growing, each region's mask recomputed at half its step, filters by area,
/// aspect ratio and fill in the ring's plane (so that tilt does not change them). Patches of noise pass all these: a
/// connector must also stand over the median of its surroundings by more than noise can explain, and its outline must
/// be a step down. Results in the workspace, connectors nearest first, all of one kind.
void find_connectors(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingFit& ring,
                     const ConnectorSettings& settings, ConnectorWorkspace& workspace);

}  // namespace pharos::tof
