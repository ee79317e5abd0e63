// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "host/vision/slam/slam_settings.hpp"
#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Fraction of the image's outline (its outermost 8 px) that is background: as dark as the darkest twentieth, but for
/// the noise of the dark pixels themselves. Smoothed by 5x5.
double dark_outline(ImageView<const std::uint8_t> image);

/// kTarget where the background is dark and without structure all around: more than half of the outline. Else kStatic:
/// something is seen everywhere. A raw image, because a rectified one may have black borders.
Scene scene_of(ImageView<const std::uint8_t> image);

}  // namespace pharos::slam
