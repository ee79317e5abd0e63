// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "pharos/camera/depth_camera.hpp"
#include "pharos/tof/tof_frame.hpp"

namespace pharos::tof {

/// Distances at which neighbours across an edge are looked for, px: the nearer one may be mixed and without depth too.
inline constexpr std::array<double, 3> kNeighbours_px = {1.5, 2.5, 3.5};
/// Minimum difference of the two sides' amplitudes over the brighter one: below it light does not tell them apart.
inline constexpr double kMinContrast = 0.2;
/// A gap of pixels without depth is no wider than this to either side of one of them, px.
inline constexpr int kMaxGap_px = 4;

/// How far the nearest pixel with depth is from one without, along `direction` (unit), px.
inline int gap_px(const TofFrame& frame, std::int32_t u, std::int32_t v, const Vector2& direction) {
  int distance = 1;
  for (; distance < kMaxGap_px; ++distance) {
    const auto du = static_cast<std::int32_t>(std::lround(distance * direction.x()));
    const auto dv = static_cast<std::int32_t>(std::lround(distance * direction.y()));
    if (frame.depth.contains(u + du, v + dv) && has_depth(frame.depth.at(u + du, v + dv))) break;
  }
  return distance;
}

/// Height of a pixel that has light but no depth, because it collects light of two surfaces and the camera gives none
/// for such pixels: these are the pixels of an edge.
///
/// Its amplitude is c A_1 + (1 - c) A_2, with the amplitudes of the nearest pixels with depth to either side along
/// `direction` (unit, across the edge); its height is that mixture's, weighted by amplitude, as a camera that does give
/// one would measure it. Where both sides are equally bright, light says nothing of c: the pixels without depth are
/// those about the edge, so that c falls from side to side of their gap. `height_at(u, v)`: of a pixel with depth.
/// Nothing where a side has no such pixel.
template <class HeightAt>
std::optional<double> mixed_height(const TofFrame& frame, std::int32_t u, std::int32_t v, const Vector2& direction,
                                   HeightAt height_at) {
  struct Side {
    double amplitude = 0.0;
    double height = 0.0;
    bool found = false;
  };
  const auto side_of = [&](double sign) {
    Side side;
    for (const double distance : kNeighbours_px) {
      const auto du = static_cast<std::int32_t>(std::lround(sign * distance * direction.x()));
      const auto dv = static_cast<std::int32_t>(std::lround(sign * distance * direction.y()));
      if (!frame.depth.contains(u + du, v + dv) || !has_depth(frame.depth.at(u + du, v + dv))) continue;
      return Side{static_cast<double>(frame.intensity.at(u + du, v + dv)), height_at(u + du, v + dv), true};
    }
    return side;
  };
  const Side one = side_of(1.0), other = side_of(-1.0);
  if (!one.found || !other.found) return std::nullopt;
  const auto fraction = [&] {
    const double contrast = one.amplitude - other.amplitude;
    if (std::fabs(contrast) > kMinContrast * std::max(one.amplitude, other.amplitude)) {
      return std::clamp((frame.intensity.at(u, v) - other.amplitude) / contrast, 0.0, 1.0);
    }
    const double to_one = gap_px(frame, u, v, direction), to_other = gap_px(frame, u, v, -direction);
    return to_other / (to_one + to_other);
  };
  const double part = fraction();
  const double first = part * one.amplitude, second = (1.0 - part) * other.amplitude;
  if (!(first + second > 0.0)) return std::nullopt;
  return (first * one.height + second * other.height) / (first + second);
}

}  // namespace pharos::tof
