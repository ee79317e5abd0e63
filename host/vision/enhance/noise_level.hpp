// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pharos/base/image_view.hpp"

namespace pharos::enhance {

/// Standard deviation of white noise in an image, 1 = white: from the high frequencies of those 8 x 8 blocks that have
/// least of the low ones (a tenth of them). Blocks that touch black or white, where noise is cut off, and blocks
/// without any high frequency do not count; 0 where fewer than 16 are left.
double noise_level(ImageView<const float> image);

}  // namespace pharos::enhance
