// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/camera/camera_calibration.hpp"

namespace pharos::calibrate {

/// Two cameras from pairs of images of a board, or why there are none.
struct RigCalibration {
  std::array<std::vector<ImageOutcome>, 2> images;  // left and right; a pair is used where both are
  std::string refusal;                              // empty: there is a result
  std::optional<BundleOutcome> outcome;             // two cameras and T_left_right
  std::array<Coverage, 2> coverage;
  std::vector<std::string> unobservable;
  std::size_t pairs = 0;
  /// Distances of points from the epipolar lines of their partners, in both images, without distortion: rms in pixels.
  double epipolar_rms_px = 0.0;
  double opencv_epipolar_rms_px = 0.0;  // with what cv::stereoCalibrate found
  double opencv_rms_px = 0.0;           // of reprojection, as it reports
};

/// Calibrates each camera from the pairs' images, finds each board's turn in the right image (only one agrees with a
/// fixed relative pose of the cameras), then adjusts both cameras, their relative pose and all boards together.
RigCalibration calibrate_rig(const std::vector<BoardPicture>& left, const std::vector<BoardPicture>& right,
                             const CalibrationChoices& choices, const StepDone& step_done = {});

}  // namespace pharos::calibrate
