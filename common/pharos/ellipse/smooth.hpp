// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "pharos/base/image_view.hpp"

namespace pharos::ellipse {

/// Gaussian filter of sigma = 1 px as the binomial kernel (1 4 6 4 1)/16 along rows and columns, borders repeated.
///
/// Made of rounded means of two 16-bit values, so that nothing overflows and no multiplication is needed. Values are
/// first shifted left as far as the largest allows: faint images keep their fractions. Returns that shift. `scratch`
/// and `smoothed` have the image's size.
int smooth(ImageView<const std::uint16_t> image, ImageView<std::uint16_t> scratch, ImageView<std::uint16_t> smoothed);

}  // namespace pharos::ellipse
