// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Of the pixels compared: 11x11.
inline constexpr int kSquareRadius_px = 5;

/// The right square as the left one sees it: a difference of brightness, the shift, and how the shift changes along u
/// and v, as it does on a surface that is seen aslant: grey values, px, px per px.
using Shift = Eigen::Vector4f;

/// Where between pixels the right square equals the left one at (u, v) best, from `column` on, by least squares with
/// the left one's slopes, which are gathered once (Lucas 1981, Baker and Matthews 2004). The left square lies inside
/// its image with a pixel to spare. Empty where it runs away or the square tells no place.
std::optional<Shift> square_shift(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v,
                                  double column);

}  // namespace pharos::slam
