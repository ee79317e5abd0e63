// SPDX-License-Identifier: Apache-2.0
#include "pharos/ellipse/edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

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

// Most of an image has no edge: blocks of pixels below the threshold are skipped at once.
constexpr std::int32_t kBlock_px = 16;
using Block = std::array<std::uint16_t, static_cast<std::size_t>(kBlock_px)>;

// 1 for pixels of a block from (u, v) on that lie above the threshold and may be the greatest along their gradient,
// else 0. All at once, without a branch or a division: a value between two others is no less than the smaller one.
Block may_be_ridges(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::int32_t u,
                    std::int32_t v, std::uint16_t low) {
  const std::uint16_t *grey = smoothed.row(v) + u, *grey_above = smoothed.row(v - 1) + u,
                      *grey_below = smoothed.row(v + 1) + u;
  const std::uint16_t *here = magnitude.row(v) + u, *above = magnitude.row(v - 1) + u,
                      *below = magnitude.row(v + 1) + u;
  Block marks;
  for (std::int32_t k = 0; k < kBlock_px; ++k) {
    const auto gu = static_cast<std::int16_t>((grey[k + 1] >> 1) - (grey[k - 1] >> 1));
    const auto gv = static_cast<std::int16_t>((grey_below[k] >> 1) - (grey_above[k] >> 1));
    const auto au = static_cast<std::int16_t>(gu < 0 ? -gu : gu), av = static_cast<std::int16_t>(gv < 0 ? -gv : gv);
    const bool flat = au >= av, falling = (gu ^ gv) >= 0;  // falling: from the upper left to the lower right
    const std::uint16_t left = here[k - 1], right = here[k + 1], up = above[k], down = below[k];
    const std::uint16_t left_up = above[k - 1], right_up = above[k + 1], left_down = below[k - 1],
                        right_down = below[k + 1];
    // The neighbours on one side of the pixel, and on the other.
    const std::uint16_t one = flat ? right : falling ? down : up;
    const std::uint16_t other = flat ? left : falling ? up : down;
    const std::uint16_t one_slanted = falling ? right_down : right_up;
    const std::uint16_t other_slanted = falling ? left_up : left_down;
    const std::uint16_t over = here[k] > low ? 1 : 0;
    const std::uint16_t over_one = here[k] >= std::min(one, one_slanted) ? 1 : 0;
    const std::uint16_t over_other = here[k] >= std::min(other, other_slanted) ? 1 : 0;
    marks[static_cast<std::size_t>(k)] = over & over_one & over_other;
  }
  return marks;
}

bool any_above(const std::uint16_t* values, std::uint16_t low) {
  std::uint16_t above = 0;
  for (std::int32_t k = 0; k < kBlock_px; ++k) above = static_cast<std::uint16_t>(above | (values[k] > low ? 1U : 0U));
  return above != 0;
}

// Calls take(number) for those of a block that are marked; four at once are skipped where none is.
template <class Take>
void for_marked(const Block& marks, Take&& take) {
  constexpr std::size_t kTogether = sizeof(std::uint64_t) / sizeof(Block::value_type);
  for (std::size_t first = 0; first < marks.size(); first += kTogether) {
    std::uint64_t together = 0;
    std::memcpy(&together, marks.data() + first, sizeof(together));
    if (together == 0) continue;
    for (std::size_t k = first; k < first + kTogether; ++k) {
      if (marks[k] != 0) take(static_cast<std::int32_t>(k));
    }
  }
}

// The edge point at a pixel whose magnitude is above the threshold, if it is the greatest along its gradient.
bool edge_at(ImageView<const std::uint16_t> smoothed, ImageView<const std::uint16_t> magnitude, std::int32_t u,
             std::int32_t v, EdgePoint& point) {
  const Gradient gradient = gradient_at(smoothed, u, v);
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
  const std::int32_t last = magnitude.width_px - kBorder_px;
  for (std::int32_t v = 0; v < magnitude.height_px; ++v) {
    std::uint16_t* place = places.row(v);
    std::fill_n(place, magnitude.width_px, std::uint16_t{0});
    if (v < kBorder_px || v >= magnitude.height_px - kBorder_px) continue;
    const std::uint16_t* row = magnitude.row(v);
    for (std::int32_t block = kBorder_px; block < last; block += kBlock_px) {
      const std::int32_t end = std::min(block + kBlock_px, last);
      const bool whole = end - block == kBlock_px;
      if (whole && !any_above(row + block, low)) continue;
      Block marks{};
      if (whole) {
        marks = may_be_ridges(smoothed, magnitude, block, v, low);
      } else {
        std::transform(row + block, row + end, marks.begin(), [low](std::uint16_t m) { return m > low ? 1 : 0; });
      }
      for_marked(marks, [&](std::int32_t k) {
        EdgePoint point;
        if (!edge_at(smoothed, magnitude, block + k, v, point)) return;
        if (workspace.edges.push_back(point)) {
          place[block + k] = static_cast<std::uint16_t>(workspace.edges.size());
        } else {
          ++workspace.counters.edge_points_dropped;
        }
      });
    }
  }
  workspace.counters.edge_points = static_cast<std::uint32_t>(workspace.edges.size());
}

}  // namespace pharos::ellipse
