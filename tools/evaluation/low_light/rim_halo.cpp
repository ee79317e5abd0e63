// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/low_light/rim_halo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pharos::tools {
namespace {

constexpr std::uint16_t kTarget = 3 * 257;
constexpr int kFarthest_px = 1000;
constexpr int kFirstRing_px = 3;  // nearer, the lens blurs the rim itself
constexpr int kLastOutside_px = 12, kGround_px = 20;
constexpr int kLastInside_px = 10, kDeep_px = 16, kAround_px = 26;
constexpr int kShades = 32;
constexpr double kMinDeep = 10.0;  // pixels of a shade

struct Mean {
  double sum = 0.0, count = 0.0;
  void add(double value) {
    sum += value;
    count += 1.0;
  }
  double value() const { return count > 0.0 ? sum / count : 0.0; }
};

// Steps (also diagonal) to the nearest pixel of the other kind; negative outside of the target.
std::vector<int> depths(ImageView<const std::uint16_t> even) {
  const std::int32_t width = even.width_px, height = even.height_px;
  const auto at = [width](std::int32_t u, std::int32_t v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  };
  const auto in_target = [&](std::int32_t u, std::int32_t v) { return even.row(v)[u] >= kTarget; };
  std::vector<int> steps(even.pixels(), kFarthest_px);
  const auto look = [&](std::int32_t u, std::int32_t v, std::int32_t du, std::int32_t dv) {
    if (!even.contains(u + du, v + dv)) return;
    const int there = in_target(u + du, v + dv) == in_target(u, v) ? steps[at(u + du, v + dv)] + 1 : 1;
    steps[at(u, v)] = std::min(steps[at(u, v)], there);
  };
  constexpr std::array<std::array<std::int32_t, 2>, 4> kBefore{{{-1, -1}, {0, -1}, {1, -1}, {-1, 0}}};
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) {
      for (const auto& [du, dv] : kBefore) look(u, v, du, dv);
    }
  }
  for (std::int32_t v = height - 1; v >= 0; --v) {
    for (std::int32_t u = width - 1; u >= 0; --u) {
      for (const auto& [du, dv] : kBefore) look(u, v, -du, -dv);
    }
  }
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) {
      if (!in_target(u, v)) steps[at(u, v)] *= -1;
    }
  }
  return steps;
}

double farthest(const std::vector<Mean>& rings) {
  double maximum = 0.0;
  for (const Mean& ring : rings) {
    if (std::abs(ring.value()) > std::abs(maximum)) maximum = ring.value();
  }
  return maximum;
}

struct Views {
  ImageView<const std::uint8_t> filtered;
  ImageView<const std::uint16_t> even;
  std::vector<int> depth;

  int depth_at(std::int32_t u, std::int32_t v) const {
    return depth[static_cast<std::size_t>(v) * static_cast<std::size_t>(even.width_px) + static_cast<std::size_t>(u)];
  }
  double light(std::int32_t u, std::int32_t v) const { return filtered.row(v)[u] / 255.0; }
  int shade(std::int32_t u, std::int32_t v) const { return even.row(v)[u] * kShades / 65536; }
  template <class Visit>
  void each(std::int32_t u0, std::int32_t v0, std::int32_t reach, Visit&& visit) const {
    for (std::int32_t v = std::max(0, v0 - reach); v <= std::min(even.height_px - 1, v0 + reach); ++v) {
      for (std::int32_t u = std::max(0, u0 - reach); u <= std::min(even.width_px - 1, u0 + reach); ++u) visit(u, v);
    }
  }
};

// Mean result of pixels of the same brightness deeper in the same part of the target.
Mean deeper(const Views& views, std::int32_t u0, std::int32_t v0) {
  Mean mean;
  const int shade = views.shade(u0, v0);
  views.each(u0, v0, kAround_px, [&](std::int32_t u, std::int32_t v) {
    if (views.depth_at(u, v) >= kDeep_px && views.shade(u, v) == shade) mean.add(views.light(u, v));
  });
  return mean;
}

}  // namespace

RimHalo rim_halo(ImageView<const std::uint8_t> filtered, ImageView<const std::uint16_t> even) {
  const Views views{filtered, even, depths(even)};
  Mean ground;
  const auto all = std::max(even.width_px, even.height_px);
  views.each(0, 0, all, [&](std::int32_t u, std::int32_t v) {
    if (views.depth_at(u, v) < -kGround_px) ground.add(views.light(u, v));
  });
  std::vector<Mean> outside(kLastOutside_px + 1), inside(kLastInside_px + 1);
  views.each(0, 0, all, [&](std::int32_t u, std::int32_t v) {
    const int depth = views.depth_at(u, v);
    const auto away = static_cast<std::size_t>(std::abs(depth));
    if (away < kFirstRing_px) return;
    if (depth < 0 && away < outside.size() && ground.count > 0.0) outside[away].add(views.light(u, v) - ground.value());
    if (depth < 0 || away >= inside.size()) return;
    const Mean deep = deeper(views, u, v);
    if (deep.count >= kMinDeep) inside[away].add(views.light(u, v) - deep.value());
  });
  return {farthest(outside), farthest(inside)};
}

}  // namespace pharos::tools
