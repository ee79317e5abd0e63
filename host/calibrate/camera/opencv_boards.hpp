// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"

namespace pharos::calibrate {

/// Parts done by OpenCV: corners of chessboards, and its own adjustments, from which ours start and with which they are
/// compared. Empty where OpenCV gives no result.

/// Inner corners in the board's order. The edge is how many pixels grey values take to rise across a square's side,
/// mean (cv::estimateChessboardSharpness).
struct Corners {
  std::vector<Vector2> pixels;
  double edge_px = 0.0;
};
std::optional<Corners> opencv_corners(ImageView<const std::uint8_t> image, const Board& board);

/// cv::calibrateCamera: the camera, the board's poses in its views, and the rms of the distances (px) that it reports.
struct OpencvCalibration {
  BundleState state;
  double rms_px = 0.0;
};
std::optional<OpencvCalibration> opencv_calibration(const Board& board, const std::vector<FoundBoard>& views,
                                                    std::int32_t width_px, std::int32_t height_px, bool fix_k3);

/// cv::stereoCalibrate from two calibrated cameras, which it adjusts too.
std::optional<OpencvCalibration> opencv_stereo(const Board& board, const std::vector<FoundBoard>& left,
                                               const std::vector<FoundBoard>& right, const PinholeCamera& left_camera,
                                               const PinholeCamera& right_camera, bool fix_k3);

}  // namespace pharos::calibrate
