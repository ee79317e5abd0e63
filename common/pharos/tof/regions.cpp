// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/regions.hpp"

#include <algorithm>

namespace pharos::tof {
namespace {

void widen(Region::Extent& extent, std::int32_t place) {
  extent.first = std::min(extent.first, static_cast<std::int16_t>(place));
  extent.last = std::max(extent.last, static_cast<std::int16_t>(place));
}

}  // namespace

bool grow_region(BitImage& mask, std::int32_t seed_u, std::int32_t seed_v, RegionWorkspace& workspace, Region& region) {
  std::size_t count = 0;
  const auto take = [&](std::int32_t u, std::int32_t v) {
    if (!mask.contains(u, v) || !mask.at(u, v)) return;
    mask.clear(u, v);
    workspace.front[count++] = static_cast<std::uint32_t>(v * kMaxWidth_px + u);
  };
  std::int64_t sum_u = 0;
  std::int64_t sum_v = 0;
  region.left = region.right = seed_u;
  region.top = region.bottom = seed_v;
  take(seed_u, seed_v);
  // A queue: removed entries stay in it, so that the outline can be made from it.
  for (std::size_t next = 0; next < count; ++next) {
    const auto u = static_cast<std::int32_t>(workspace.front[next] % kMaxWidth_px);
    const auto v = static_cast<std::int32_t>(workspace.front[next] / kMaxWidth_px);
    sum_u += u;
    sum_v += v;
    region.left = std::min(region.left, u);
    region.right = std::max(region.right, u);
    region.top = std::min(region.top, v);
    region.bottom = std::max(region.bottom, v);
    take(u - 1, v);
    take(u + 1, v);
    take(u, v - 1);
    take(u, v + 1);
  }
  region.area_px = static_cast<std::int32_t>(count);
  if (count == 0) return false;
  region.u_px = static_cast<double>(sum_u) / static_cast<double>(count);
  region.v_px = static_cast<double>(sum_v) / static_cast<double>(count);
  if (region.rows() > kMaxRegionSide_px || region.columns() > kMaxRegionSide_px) return false;
  constexpr Region::Extent kNone = {kMaxWidth_px, -1};
  std::fill_n(region.row.begin(), region.rows(), kNone);
  std::fill_n(region.column.begin(), region.columns(), kNone);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = static_cast<std::int32_t>(workspace.front[i] % kMaxWidth_px);
    const auto v = static_cast<std::int32_t>(workspace.front[i] / kMaxWidth_px);
    widen(region.row[static_cast<std::size_t>(v - region.top)], u);
    widen(region.column[static_cast<std::size_t>(u - region.left)], v);
  }
  return true;
}

}  // namespace pharos::tof
