// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/evaluation/low_light/low_light_peers.hpp"

namespace pharos::tools {

// The methods beside LIME in figure 4 of paper 004, each from its own publication, for grey images of 8 bits: the three
// colours are equal. README.md says what each publication leaves open.

/// MSRCR: D. Jobson, Z. Rahman, G. Woodell, "A multiscale retinex for bridging the gap between color images and the
/// human observation of scenes", IEEE Trans. Image Processing 6 (1997).
GreyBytes msrcr(const GreyBytes& image, int width_px, int height_px);

/// X. Dong et al., "Fast efficient algorithm for enhancement of low lighting video", ICME 2011: the inverted image is
/// freed of haze by its dark channel.
GreyBytes dong(const GreyBytes& image, int width_px, int height_px);

/// BIMEF: Z. Ying, G. Li, W. Gao, "A bio-inspired multi-exposure fusion framework for low-light image enhancement",
/// arXiv 1711.00591 (2017).
GreyBytes bimef(const GreyBytes& image, int width_px, int height_px);

/// SRIE: X. Fu, D. Zeng, Y. Huang, X. Zhang, X. Ding, "A weighted variational model for simultaneous reflectance and
/// illumination estimation", CVPR 2016.
GreyBytes srie(const GreyBytes& image, int width_px, int height_px);

}  // namespace pharos::tools
