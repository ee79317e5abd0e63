// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace pharos::slam {

/// A corner candidate in its pyramid level.
struct Corner {
  float u_px = 0.0F;
  float v_px = 0.0F;
  float response = 0.0F;
};

/// About `wanted` of the corners, distributed over the image: the area is split in four repeatedly, the largest part
/// first and of equal ones the one with most corners, until there are as many parts as wanted; each gives its strongest
/// corner (Mur-Artal 2015, section V.A). Order of the result depends on the input alone.
std::vector<Corner> spread(std::vector<Corner> corners, float width_px, float height_px, std::size_t wanted);

}  // namespace pharos::slam
