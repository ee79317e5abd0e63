// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "pharos/base/image_view.hpp"

namespace pharos::slam {

/// Half side of the compared square: 11x11 pixels.
inline constexpr int kSquareRadius_px = 5;

/// Mapping from the left square to the right one: difference of brightness (grey values), shift (px), and the gradient
/// of the shift along u and v on an oblique surface (px per px).
using Shift = Eigen::Vector4f;

/// Sub-pixel position of the right square that best equals the left one at (u, v), starting at `column`, by least
/// squares with the left one's gradients, which are computed once (Lucas 1981, Baker and Matthews 2004). The left
/// square must be inside its image with a margin of one pixel. Empty where the iteration diverges or the square does
/// not determine a position.
std::optional<Shift> square_shift(ImageView<const std::uint8_t> left, ImageView<const std::uint8_t> right, int u, int v,
                                  double column);

}  // namespace pharos::slam
