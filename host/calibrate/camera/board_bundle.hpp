// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/camera/board.hpp"
#include "host/calibrate/camera/board_image.hpp"
#include "host/calibrate/camera/found_board.hpp"

namespace pharos::calibrate {

using LeftFromRight = Pose<frame::Camera, frame::Camera>;

/// Unknowns: one camera, or two that are fixed to each other, and the board's pose in each view.
struct BundleState {
  std::vector<PinholeCamera> cameras;           // one, or left and right
  LeftFromRight T_left_right;                   // of two
  std::vector<CameraFromBoard> T_camera_board;  // of each view, in the first camera
};

/// Measurements: found[camera][view], each board complete.
struct BundleData {
  Board board;
  bool fix_k3 = false;
  std::vector<std::vector<FoundBoard>> found;
};

struct BundleOutcome {
  BundleState state;
  std::vector<std::string> parameters;  // fx_px … k3 of each camera; then the right camera's rotation and position
  Eigen::MatrixXd covariance;           // of them. Rotation (rad) before position (m), in the left camera's frame
  double rms_px = 0.0;                  // of the distances between found and predicted points
  std::vector<std::vector<double>> view_rms_px;  // [camera][view]
  /// Residuals over their expectation from the points' own sigmas: 1 where the image noise explains them. The
  /// covariance includes this factor.
  double noise_ratio = 0.0;
  /// Found over predicted area of the dots, median: the square of the printed radius over the stated one. 1 for
  /// corners.
  double area_ratio = 1.0;
};

/// Least squares over all points of all views, by Ceres. Empty where the start has a point behind a camera or the
/// covariance does not exist.
std::optional<BundleOutcome> adjust_boards(BundleState start, const BundleData& data);

}  // namespace pharos::calibrate
