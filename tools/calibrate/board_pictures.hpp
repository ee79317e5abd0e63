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
  /// An image that `input` cannot read is reported and counted, and is a picture without pixels.
  BoardPictures(const std::vector<std::string>& paths, ImageInput& input);

  const std::vector<calibrate::BoardPicture>& pictures() const { return pictures_; }

 private:
  std::vector<host::GreyImage> images_;
  std::vector<calibrate::BoardPicture> pictures_;
};

/// Draws the points found over each image: NAME.png in `folder`, which is created where it does not exist. Points in
/// the board's order, the first one marked; residuals (green) a thousand times as long where the dots are, a hundred
/// times for corners. On an image that was not used, the reason is written. `poses` are of the images used, in order.
void write_board_overlays(const std::string& folder, const std::string& prefix, const BoardPictures& pictures,
                          const std::vector<calibrate::ImageOutcome>& images, const calibrate::Board& board,
                          const PinholeCamera* camera, const std::vector<calibrate::CameraFromBoard>& poses);

}  // namespace pharos::tools
