// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace pharos::tof {

/// Parts of measure_tof_pose, in their order.
enum class TofStage : std::uint8_t {
  kCheck,      ///< sizes, saturation, stale rows; the lens' rays where the camera is new
  kEdges,      ///< filter, thresholds, edge points along contours
  kEllipses,   ///< arcs, pairs, fits
  kPlane,      ///< planes and steps in the depths of nested ellipses
  kRing,       /// ends of its face, its edges, the joint fit
  kFace,       /// relief over the satellite's face: only where the intensity image shows no ring
  kConnector,  ///< heights, local threshold, regions, filters
  kPose        ///< the connectors' edges, target frame, covariance
};
inline constexpr std::size_t kTofStages = 8;
/// One word: "edges".
const char* name_of(TofStage stage);

/// Notified whenever a stage has ended; a frame may repeat a stage. The core has no clock: the listener has one.
class TofStageListener {
 public:
  virtual void ended(TofStage stage) = 0;

 protected:
  ~TofStageListener() = default;
};

}  // namespace pharos::tof
