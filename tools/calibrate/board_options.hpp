// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "host/calibrate/camera/camera_calibration.hpp"

namespace CLI {
class App;
}

namespace pharos::tools {

/// Options of both `calibrate camera` and `calibrate stereo`.
struct BoardOptions {
  std::string board = "dots";
  int columns = 0;  // 0: not given
  int rows = 0;
  double pitch_mm = 0.0;
  double radius_mm = 5.0;
  bool fix_k3 = false;
  std::string dot_threshold = "local";
  std::string output;
  std::string images;
  std::string overlay;
  bool json = false;
};

void add_board_options(CLI::App& command, BoardOptions& options);

/// Throws InputError for a chessboard without its numbers and for dots that would touch.
calibrate::CalibrationChoices choices_of(const BoardOptions& options);

}  // namespace pharos::tools
