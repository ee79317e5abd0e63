// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pharos/base/image_view.hpp"
#include "pharos/camera/depth_camera.hpp"
#include "pharos/geometry/pose.hpp"
#include "tools/sim/tof/sensor.hpp"

namespace pharos::tools::paper000 {

// Sections 2.2 and 2.3 of paper 000 on one frame, from its own steps alone: no ring fit, ellipse or region of ours.

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

/// The frame's depth as 256 grey values over `span_m` about the middle of its depths; 0 where there is none.
ChainStages grey_of(const sim::TofPixels& pixels, const DepthCamera& camera, double span_m);

struct ChainResult {
  ChainStages stages;
  std::optional<Pose<frame::Camera, frame::Target>> pose;
  std::string why;  ///< no pose: at which step it ends
};

/// The whole chain on 8-bit depth. 2.3: the mean of the ring's two ellipses, a plane through the depths at eight points
/// of it, its centre on that plane, the nearest connector's middle.
ChainResult measure(const sim::TofPixels& eight_bit, const DepthCamera& camera, const ChainSettings& settings);

}  // namespace pharos::tools::paper000
