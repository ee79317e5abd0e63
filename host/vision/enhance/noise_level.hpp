// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/image_view.hpp"

namespace pharos::enhance {

/// Standard deviation of white noise in an image, 1 = white: from the high frequencies of the tenth of 8 x 8 blocks
/// with the lowest energy in low ones. Blocks that touch black or white, where noise is clipped, and blocks without any
/// high frequency do not count; 0 where fewer than 16 remain.
double noise_level(ImageView<const float> image);

}  // namespace pharos::enhance
