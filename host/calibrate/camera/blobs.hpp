// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "host/calibrate/camera/found_board.hpp"
#include "pharos/camera/pinhole_camera.hpp"

namespace pharos::calibrate {

/// A spot that may be a dot, from the moments of its mask.
struct Blob {
  Vector2 centre_px = Vector2::Zero();
  Matrix2 covariance_px2 = Matrix2::Identity();  // of a filled ellipse: a quarter of its squared semi-axes
  bool cut = false;                              // touches the image's border
  double area_px() const;
};

/// What separates dots from the sheet.
enum class DotThreshold : std::uint8_t {
  kLocal,  ///< of each pixel's surroundings
  kOtsu,   ///< one for the image, as paper 000 (section 2.1, step 2)
};

/// Spots brighter (or darker) than their surroundings within `window_px`: pixels beyond the window's mean by more than
/// 3/4 of its standard deviation, where that exceeds the noise; connected pixels whose outline is an ellipse.
std::vector<Blob> find_blobs(GreyView image, int window_px, bool bright);

/// The same by Otsu's threshold (N. Otsu 1979) over the image after a Gaussian of 5 pixels, on grey values of 8 bits.
std::vector<Blob> find_blobs_by_otsu(GreyView image, bool bright);

}  // namespace pharos::calibrate
