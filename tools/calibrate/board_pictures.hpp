// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/camera/camera_calibration.hpp"
#include "tools/support/image_input.hpp"

namespace pharos::tools {

/// Images of a board, in memory.
class BoardPictures {
 public:
  /// An image that `input` cannot read is told, counted, and a picture without pixels.
  BoardPictures(const std::vector<std::string>& paths, ImageInput& input);

  const std::vector<calibrate::BoardPicture>& pictures() const { return pictures_; }

 private:
  std::vector<host::GreyImage> images_;
  std::vector<calibrate::BoardPicture> pictures_;
};

/// What was found in each image, drawn over it: NAME.png in `folder`, which is made where it is not there. Points in
/// the board's order, the first one marked; residuals (green) a thousand times as long where the dots are, a hundred
/// times for corners. An image that was not used carries the reason. `poses` are of the images used, in order.
void write_board_overlays(const std::string& folder, const std::string& prefix, const BoardPictures& pictures,
                          const std::vector<calibrate::ImageOutcome>& images, const calibrate::Board& board,
                          const PinholeCamera* camera, const std::vector<calibrate::CameraFromBoard>& poses);

}  // namespace pharos::tools
