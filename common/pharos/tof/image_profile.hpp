// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/image_view.hpp"
#include "pharos/geometry/types.hpp"

namespace pharos::tof {

/// The steepest point of a profile.
struct ProfileEdge {
  double offset_px = 0.0;  ///< from the profile's middle, along its direction
  double strength = 0.0;   ///< grey values per px; 0: none
};

/// Maximum search distance of a profile to either side.
inline constexpr int kMaxSearch_px = 6;

/// Samples for a search of kMaxSearch_px.
inline constexpr int kProfileReach_px = 3;
inline constexpr std::size_t kMaxSamples = 2 * (kMaxSearch_px + kProfileReach_px) + 1;

/// Steepest change of 2 (search_px + kProfileReach_px) + 1 samples, 1 px apart, within `search_px` of their middle,
/// smoothed by a Gaussian of 1 px and interpolated by a parabola. `sign` 1: rising, -1: falling. None where the change
/// still grows where the search ends.
ProfileEdge steepest_of_samples(const std::array<double, kMaxSamples>& profile, int search_px, double sign);

}  // namespace pharos::tof
