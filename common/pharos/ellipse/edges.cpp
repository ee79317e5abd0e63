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

}  // namespace

void find_edges(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::uint16_t low,
                ImageView<std::uint16_t> places, EllipseWorkspace& workspace) {
  workspace.edges.clear();
  for (std::int32_t v = 0; v < magnitude.height_px; ++v) {
    std::uint16_t* place = places.row(v);
    std::fill_n(place, magnitude.width_px, std::uint16_t{0});
    const std::uint16_t* row = magnitude.row(v);
    for (std::int32_t u = 1; u < magnitude.width_px - 1; ++u) {  // the border rows' magnitude is 0
      if (row[u] <= low) continue;
      const Gradient gradient = gradient_at(smoothed, u, v);
      const Profile profile = profile_of(magnitude, u, v, gradient);
      if (!profile.is_ridge()) continue;
      const float top = profile.top();
      const EdgePoint point{static_cast<float>(u) + top * profile.step_u,
                            static_cast<float>(v) + top * profile.step_v,
                            gradient.u,
                            gradient.v,
                            static_cast<std::uint16_t>(u),
                            static_cast<std::uint16_t>(v)};
      if (!workspace.edges.push_back(point)) {
        ++workspace.counters.edge_points_dropped;
        continue;
      }
      place[u] = static_cast<std::uint16_t>(workspace.edges.size());
    }
  }
  workspace.counters.edge_points = static_cast<std::uint32_t>(workspace.edges.size());
}

}  // namespace pharos::ellipse
