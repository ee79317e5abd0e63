// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/edges.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::ellipse {
namespace {

// Magnitudes one step before, at and after a pixel along its gradient; the step ends on the next column or row.
struct Profile {
  float before = 0.0F, here = 0.0F, after = 0.0F;
  float step_u = 0.0F, step_v = 0.0F;

  bool is_ridge() const { return here >= before && here > after; }
  float top() const {
    const float bend = before - 2.0F * here + after;
    return bend < 0.0F ? std::clamp(0.5F * (before - after) / bend, -0.5F, 0.5F) : 0.0F;
  }
};

Profile profile_of(ImageView<const std::uint16_t> magnitude, std::int32_t u, std::int32_t v, Gradient gradient) {
  const int gu = gradient.u, gv = gradient.v;
  const int au = std::abs(gu), av = std::abs(gv);
  const int su = gu < 0 ? -1 : 1, sv = gv < 0 ? -1 : 1;
  const auto at = [&](int du, int dv) { return static_cast<float>(magnitude.at(u + du, v + dv)); };
  const bool flat = au >= av;
  const float slant = static_cast<float>(flat ? av : au) / static_cast<float>(flat ? au : av);
  const int straight_u = flat ? su : 0, straight_v = flat ? 0 : sv;
  const auto between = [&](int side) {
    return at(side * straight_u, side * straight_v) * (1.0F - slant) + at(side * su, side * sv) * slant;
  };
  Profile profile{between(-1), at(0, 0), between(1), static_cast<float>(su), static_cast<float>(sv)};
  (flat ? profile.step_v : profile.step_u) *= slant;
  return profile;
}

// False for most pixels that are no ridge, without a division: what lies between two values is no less than the
// smaller.
bool may_be_ridge(ImageView<const std::uint16_t> magnitude, std::int32_t u, std::int32_t v, Gradient gradient) {
  const int su = gradient.u < 0 ? -1 : 1, sv = gradient.v < 0 ? -1 : 1;
  const bool flat = std::abs(gradient.u) >= std::abs(gradient.v);
  const int straight_u = flat ? su : 0, straight_v = flat ? 0 : sv;
  const std::uint16_t here = magnitude.at(u, v);
  return here >= std::min(magnitude.at(u + straight_u, v + straight_v), magnitude.at(u + su, v + sv)) &&
         here >= std::min(magnitude.at(u - straight_u, v - straight_v), magnitude.at(u - su, v - sv));
}

// Most of an image is no edge: blocks of pixels below the threshold are passed over at once.
constexpr std::int32_t kBlock_px = 16;

bool any_above(const std::uint16_t* values, std::uint16_t low) {
  std::uint16_t above = 0;
  for (std::int32_t k = 0; k < kBlock_px; ++k) above = static_cast<std::uint16_t>(above | (values[k] > low ? 1U : 0U));
  return above != 0;
}

// The edge point at a pixel whose magnitude is above the threshold, if it is the greatest along its gradient.
bool edge_at(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::int32_t u,
             std::int32_t v, EdgePoint& point) {
  const Gradient gradient = gradient_at(smoothed, u, v);
  if (!may_be_ridge(magnitude, u, v, gradient)) return false;
  const Profile profile = profile_of(magnitude, u, v, gradient);
  if (!profile.is_ridge()) return false;
  const float top = profile.top();
  point = {static_cast<float>(u) + top * profile.step_u,
           static_cast<float>(v) + top * profile.step_v,
           gradient.u,
           gradient.v,
           static_cast<std::uint16_t>(u),
           static_cast<std::uint16_t>(v)};
  return true;
}

}  // namespace

void find_edges(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::uint16_t low,
                ImageView<std::uint16_t> places, EllipseWorkspace& workspace) {
  workspace.edges.clear();
  const std::int32_t last = magnitude.width_px - 1;
  for (std::int32_t v = 0; v < magnitude.height_px; ++v) {
    std::uint16_t* place = places.row(v);
    std::fill_n(place, magnitude.width_px, std::uint16_t{0});
    const std::uint16_t* row = magnitude.row(v);  // 0 along the border
    for (std::int32_t block = 1; block < last; block += kBlock_px) {
      const std::int32_t end = std::min(block + kBlock_px, last);
      if (end - block == kBlock_px && !any_above(row + block, low)) continue;
      for (std::int32_t u = block; u < end; ++u) {
        EdgePoint point;
        if (row[u] <= low || !edge_at(smoothed, magnitude, u, v, point)) continue;
        if (workspace.edges.push_back(point)) {
          place[u] = static_cast<std::uint16_t>(workspace.edges.size());
        } else {
          ++workspace.counters.edge_points_dropped;
        }
      }
    }
  }
  workspace.counters.edge_points = static_cast<std::uint32_t>(workspace.edges.size());
}

}  // namespace pharos::ellipse
