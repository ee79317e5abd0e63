// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/camera/board_bundle.hpp"
#include "host/calibrate/camera/coverage.hpp"
#include "host/calibrate/camera/find_board.hpp"

namespace pharos::calibrate {

/// Outcome of one image; every image has one.
struct ImageOutcome {
  std::string name;
  BoardSearch search;
  double rms_px = 0.0;   // when used
  std::size_t view = 0;  // when used: its index among the views
};

/// A camera from images of a board, or why there is none.
struct CameraCalibration {
  std::vector<ImageOutcome> images;
  std::string refusal;  // empty: there is a result
  std::optional<BundleOutcome> outcome;
  Coverage coverage;
  std::vector<std::string> unobservable;
  double opencv_rms_px = 0.0;  // as cv::calibrateCamera reports for the same points, without the dots' centroid model
  const PinholeCamera& camera() const { return outcome->state.cameras.front(); }
};

struct CalibrationChoices {
  Board board;
  bool fix_k3 = false;
  DotThreshold dot_threshold = DotThreshold::kLocal;
};

/// Called after each image that was searched.
using StepDone = std::function<void()>;

/// Finds the board in each image, starts from OpenCV's adjustment, adjusts with the dots' centroid model and refuses
/// sets that do not determine a camera. Throws host::InputError where OpenCV's module is not there.
CameraCalibration calibrate_camera(const std::vector<BoardPicture>& pictures, const CalibrationChoices& choices,
                                   const StepDone& step_done = {});

/// The same from boards already found.
CameraCalibration calibrate_camera(std::vector<ImageOutcome> images, int width_px, int height_px,
                                   const CalibrationChoices& choices);

/// Boards in pictures that all must have the first one's size.
std::vector<ImageOutcome> find_boards(const std::vector<BoardPicture>& pictures, const CalibrationChoices& choices,
                                      const StepDone& step_done);

}  // namespace pharos::calibrate
