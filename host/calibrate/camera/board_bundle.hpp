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

/// What is adjusted: one camera, or two that are fixed to each other, and the board's pose in each view.
struct BundleState {
  std::vector<PinholeCamera> cameras;           // one, or left and right
  LeftFromRight T_left_right;                   // of two
  std::vector<CameraFromBoard> T_camera_board;  // of each view, in the first camera
};

/// What it is adjusted to: found[camera][view], each whole.
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
  /// Residuals over what the points' own sigmas let expect: 1 where the image noise explains all. Part of the
  /// covariance.
  double noise_ratio = 0.0;
  /// Dots' areas as found over as predicted, median: their radius squared, as printed over as told. 1 for corners.
  double area_ratio = 1.0;
};

/// Least squares over all points of all views, by Ceres. Nothing where the start shows a point behind a camera or the
/// covariance does not exist.
std::optional<BundleOutcome> adjust_boards(BundleState start, const BundleData& data);

}  // namespace pharos::calibrate
