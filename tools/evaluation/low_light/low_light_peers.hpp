// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace pharos::tools {

/// Peers for dark images, by OpenCV: grey images of 8 bits without gaps, one thread.
using GreyBytes = std::vector<std::uint8_t>;

/// fastNlMeansDenoising, windows of 7 and 21 pixels.
GreyBytes non_local_means(const GreyBytes& image, int width_px, int height_px, float strength);
/// CLAHE, limit 4, 8 x 8 tiles.
GreyBytes clahe(const GreyBytes& image, int width_px, int height_px);
/// Retinex at the scales 15, 80 and 250 px with equal weights, stretched from 1 to 99 %.
GreyBytes multi_scale_retinex(const GreyBytes& image, int width_px, int height_px);
/// 1000 ORB features each, matched in both directions; the number of inliers of one fundamental matrix (RANSAC, 1 px).
int inliers_of_orb(const GreyBytes& first, const GreyBytes& second, int width_px, int height_px);

}  // namespace pharos::tools
