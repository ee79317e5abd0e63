// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "pharos/base/static_vector.hpp"
#include "pharos/tof/ring_edges.hpp"
#include "pharos/tof/ring_model.hpp"

namespace pharos::tof {

/// A pixel about the ring: where it lies across the ring, and what it collects.
struct RingPixel {
  float beyond_outer_px = 0.0F;  ///< distance from the outer circle's image, outwards
  float height_m = 0.0F;         ///< over the plane
  std::uint16_t light = 0;       ///< counts
  std::uint16_t direction = 0;
};

inline constexpr std::size_t kRingDirections = 256;
inline constexpr std::size_t kMaxRingPixels = 10240;

/// One direction from the ring's middle: geometry of both edges, walls in sight, and what lies behind.
struct RingDirection {
  Vector2 plan = Vector2::Zero();  ///< unit, along axes_of
  std::array<Vector7, 2> row;      ///< by RingEdge
  std::array<double, 2> per_m{};   ///< px per metre of radius
  double width_px = 0.0;           ///< between the edges, by the inner one's scale
  /// Of a wall in sight beyond the edge: width of its image, px (0: none), light over the face's by the cosine law.
  std::array<double, 2> foot_px{}, wall{};
  std::array<double, 2> base_m{};      ///< height behind the edge; 0: not known
  std::array<double, 2> base_light{};  ///< and its light, counts
  double light = 0.0;                  ///< of the ring's face, counts
  std::array<double, 2> moved_px{};    ///< by the step so far
  bool seen = false;
};

/// Directions whose surroundings, and whose face's light, are taken together.
inline constexpr std::size_t kDirectionsTogether = 4;
inline constexpr std::size_t kRingSectors = kRingDirections / kDirectionsTogether;

struct RingPixels {
  StaticVector<RingPixel, kMaxRingPixels> pixels;
  std::array<RingDirection, kRingDirections> directions;
  double base_m = 0.0;  ///< how deep what lies behind the ring is, typically

  /// How far beyond an edge, away from the ring's face, px.
  double beyond_px(const RingPixel& pixel, std::size_t edge) const {
    const double outer = pixel.beyond_outer_px;
    if (edge == 0) return outer;
    const RingDirection& one = directions[pixel.direction];
    return -(one.width_px + outer * one.per_m[1] / one.per_m[0]);
  }
};

/// Every pixel within reach of the ring's two edges; of a ring that fills the image every second, third, ... row. Left
/// out: saturated ones, what stands before the ring, directions in which its middle line is hidden, and pixels that
/// have light but no depth, whatever they would have said. False where too few are left or the ring's image cannot be
/// computed.
bool gather_ring_pixels(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                        const RingPrior& prior, RingPixels& pixels);

}  // namespace pharos::tof
