// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "host/vision/slam/feature.hpp"
#include "host/vision/slam/orb_extractor.hpp"

namespace pharos::slam {

/// What a pair's match found beside depths; the last two where the order is checked.
struct StereoMatchStats {
  int matched = 0;   ///< features that have a depth
  int swapped = 0;   ///< features whose likeness lies on the wrong side: of exchanged images, most
  int off_rows = 0;  ///< features whose likeness lies 3 to 12 rows off, and in no row near
};

/// Gives the left features their columns in the right image: likest right feature of the same rows and near level,
/// then the shift of 11x11 pixels of that level with the least sum of differences (Mur-Artal 2017, section III.A),
/// placed between pixels, with its change across the square, by least squares (Lucas 1981, Baker and Matthews 2004);
/// matches whose pixels differ far more than the others' are dropped. `min_depth_m` bounds the search; `check_order`
/// also looks where exchanged or wrong images would have the likenesses.
StereoMatchStats match_stereo(std::vector<Feature>& left, const std::vector<Feature>& right,
                              const std::vector<PyramidLevel>& left_pyramid,
                              const std::vector<PyramidLevel>& right_pyramid, const StereoCamera& camera,
                              double min_depth_m, bool check_order);

}  // namespace pharos::slam
