// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/image_view.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::tof {

/// The steepest place of a profile.
struct ProfileEdge {
  double offset_px = 0.0;  ///< from the profile's middle, along its direction
  double strength = 0.0;   ///< grey values per px; 0: none
  double before = 0.0;     ///< grey values two to three px before the edge and beyond it
  double beyond = 0.0;
};

/// Farthest that a profile is searched to either side.
inline constexpr int kMostSearch_px = 6;

/// Steepest change of the image along `direction` (unit) within `search_px` of `middle`, smoothed by a Gaussian of
/// 1 px and interpolated by a parabola. `sign` 1: rising, -1: falling. None where the profile leaves the image or the
/// change still grows where the search ends.
ProfileEdge steepest_on_profile(const ImageView<const std::uint16_t>& image, const Eigen::Matrix<double, 2, 1>& middle,
                                const Eigen::Matrix<double, 2, 1>& direction, int search_px, double sign);

}  // namespace pharos::tof
