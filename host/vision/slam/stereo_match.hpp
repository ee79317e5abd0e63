// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/feature.hpp"
#include "host/vision/slam/orb_extractor.hpp"

namespace pharos::slam {

/// Statistics of a pair's match; the last two only where the order is checked.
struct StereoMatchStats {
  int matched = 0;   ///< features that have a depth
  int swapped = 0;   ///< features whose match is on the wrong side: most of them in exchanged images
  int off_rows = 0;  ///< features whose match is 3 to 12 rows away, with none in a nearer row
};

/// Sets the left features' columns in the right image: best right feature of the same rows and a near level by
/// descriptor, then the shift of 11x11 pixels of that level with the smallest sum of absolute differences (Mur-Artal
/// 2017, section III.A), refined to sub-pixels, with its gradient across the square, by least squares (Lucas 1981,
/// Baker and Matthews 2004); matches whose pixels differ far more than the others' are dropped. `min_depth_m` bounds
/// the search; `check_order` also searches where exchanged or wrong images would have the matches.
StereoMatchStats match_stereo(std::vector<Feature>& left, const std::vector<Feature>& right,
                              const std::vector<PyramidLevel>& left_pyramid,
                              const std::vector<PyramidLevel>& right_pyramid, const StereoCamera& camera,
                              double min_depth_m, bool check_order);

}  // namespace pharos::slam
