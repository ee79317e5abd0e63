// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

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
  double inner_scale = 1.0;        ///< of that scale over the outer edge's
  /// Of a wall in sight beyond the edge: width of its image, px (0: none), light over the face's by the cosine law.
  std::array<double, 2> foot_px{}, wall{};
  std::array<double, 2> base_m{};      ///< height behind the edge; 0: not known
  std::array<double, 2> base_light{};  ///< and its light, counts
  double light = 0.0;                  ///< of the ring's face, counts
  std::array<double, 2> moved_px{};    ///< by the step so far
  bool seen = false;

  /// How far beyond an edge, away from the ring's face, px; from how far beyond the outer one.
  double beyond_px(double beyond_outer_px, std::size_t edge) const {
    return edge == 0 ? beyond_outer_px : -(width_px + beyond_outer_px * inner_scale);
  }
};

/// Directions whose surroundings, and whose face's light, are taken together.
inline constexpr std::size_t kDirectionsTogether = 4;
inline constexpr std::size_t kRingSectors = kRingDirections / kDirectionsTogether;

struct RingPixels {
  StaticVector<RingPixel, kMaxRingPixels> pixels;  ///< those of a direction together
  std::array<std::uint16_t, kRingDirections + 1> begin{};
  std::array<RingDirection, kRingDirections> directions;
  double base_m = 0.0;  ///< how deep what lies behind the ring is, typically

  std::span<const RingPixel> of(std::size_t direction) const {
    return {pixels.data() + begin[direction], pixels.data() + begin[direction + 1]};
  }
};

/// Every pixel within reach of the ring's two edges; of a ring that fills the image every second, third, ... row. Left
/// out: saturated ones, what stands before the ring, directions in which its middle line is hidden, and pixels that
/// have light but no depth, whatever they would have said. False where too few are left or the ring's image cannot be
/// computed.
bool gather_ring_pixels(const TofFrame& frame, const DepthCamera& camera, const RayGrid& rays, const RingModel& model,
                        const RingPrior& prior, RingPixels& pixels);

}  // namespace pharos::tof
