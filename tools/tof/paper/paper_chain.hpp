// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/base/result.hpp"
#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/pose.hpp"

namespace pharos::tools::paper000 {

// Sections 2.2 and 2.3 of paper 000 on one frame, from its own steps alone: no ring fit, ellipse or region of ours.

/// Counts of Z, of a camera file's scale; see has_depth.
using DepthView = ImageView<const std::uint16_t>;

struct ChainSettings {
  /// (5) with the mean grey value under the root, as printed; false: with the number of pixels.
  bool printed_threshold = true;
};

/// An ellipse in the image: semi-axes a >= b, direction of a from +u towards +v.
struct PaperEllipse {
  double cx_px = 0.0, cy_px = 0.0, a_px = 0.0, b_px = 0.0, theta_rad = 0.0;
  double score = 0.0;  ///< F_val
};

using Arc = std::vector<Vector2>;

/// A connected region that the rules have not yet left out.
struct Region {
  std::vector<std::array<std::int32_t, 2>> pixels;  ///< u, v
  Vector2 middle_px = Vector2::Zero();
};

/// What each step found: figures 5 and 6.
struct ChainStages {
  std::int32_t width_px = 0, height_px = 0;
  std::vector<std::uint8_t> grey;  ///< depth in 256 values, near is bright
  std::vector<Arc> edges;          ///< linked edge points
  std::vector<Arc> arcs;           ///< divided, the short and the straight ones left out
  std::vector<PaperEllipse> fitted;
  std::vector<PaperEllipse> accepted;               ///< after clustering and verification
  std::optional<std::array<PaperEllipse, 2>> ring;  ///< outer, inner
  std::vector<std::uint8_t> above;                  ///< 255 where G > T
  std::array<std::vector<Region>, 4> regions;       ///< after morphology, area, aspect ratio, filling
};

/// 2.2.1: the ring's two ellipses.
void find_ring(ChainStages& stages);
/// 2.2.2: connectors; needs the ring.
void find_connectors(ChainStages& stages, const ChainSettings& settings);

/// The depths rounded to 256 values over 1 m about the middle of the frame's depths: one is 3.9 mm, "some millimetres".
/// What is farther off has no depth. The middle is rounded to 0.1 m, so that the values do not change from frame to
/// frame. Rows without gaps.
std::vector<std::uint16_t> eight_bit_depth(DepthView depth, const DepthCamera& camera);

/// At which step a frame without a pose ends.
enum class ChainFailure : std::uint8_t {
  kNoRing,       ///< no two ellipses of a ring
  kNoConnector,  ///< no region passes all rules
  kNoDepth,      ///< no depth at a point of the ring or at the connector's middle
  kNoPlane,      ///< the ring's points are in no plane before the camera
  kUnusable,     ///< OpenCV refuses the frame's numbers
};
/// The word after refused_: no_ring, ...
std::string_view name_of(ChainFailure failure);

/// 2.3: the mean of the ring's two ellipses, a plane through the depths at eight points of it, its centre on that
/// plane, X' towards the connector's middle in the image.
Result<Pose<frame::Camera, frame::Target>, ChainFailure> pose_from(DepthView eight_bit, const DepthCamera& camera,
                                                                   const std::array<PaperEllipse, 2>& ring,
                                                                   const Vector2& connector_px);

struct ChainResult {
  ChainStages stages;
  std::optional<Vector2> connector_px;  ///< the middle of the region nearest to the ring's centre
  std::optional<Pose<frame::Camera, frame::Target>> pose;
  std::optional<ChainFailure> failure;  ///< of no pose
};

/// The whole chain on 8-bit depth (eight_bit_depth). The paper states no uncertainty and refuses nothing that these
/// steps answer.
ChainResult measure(DepthView eight_bit, const DepthCamera& camera, const ChainSettings& settings);

}  // namespace pharos::tools::paper000
