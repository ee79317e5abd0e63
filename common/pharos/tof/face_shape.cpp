// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/face_shape.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::tof {
namespace {

// A corner begins at this fraction of both half sides; a disc of the square's area has this radius in half sides.
constexpr double kCorner = 0.6;
constexpr double kDiscRadius = 1.1283791670955126;  // 2 / sqrt(pi)

}  // namespace

void compare_with_disc(std::span<const FacePixel> pixels, const FaceSides& sides, const FaceLight& light,
                       ConnectorFace& face) {
  const PlanarRectangle& r = face.rectangle;
  const double half = std::sqrt(r.half_sides_m.x() * r.half_sides_m.y());
  const double blur = 0.5 * (sides.along.blur_m + sides.across.blur_m);
  const auto beside_wall = [](const EdgeProfile& side, double place) {
    return side.foot_m * place > 0.0 && std::fabs(side.foot_m) > 0.2 * side.blur_m;
  };
  double squares = 0.0, product = 0.0;
  for (const FacePixel& p : pixels) {
    const Vector2 off = p.place_m - r.centre_m;
    const double s = sides.first.dot(off), t = sides.second.dot(off);
    const double across_s = std::fabs(s) / r.half_sides_m.x(), across_t = std::fabs(t) / r.half_sides_m.y();
    if (std::min(across_s, across_t) < kCorner || beside_wall(sides.along, s) || beside_wall(sides.across, t)) continue;
    const double rectangle = sides.along.at(s, 0.0).value * sides.across.at(t, 0.0).value;
    const double disc = blurred_step(half * (kDiscRadius - std::hypot(across_s, across_t)), blur).value;
    const double weight = static_cast<double>(p.weight), difference = weight * (rectangle - disc);
    squares += difference * difference;
    product += difference * weight * (static_cast<double>(p.layer) / light.brightness - disc);
  }
  if (!(squares > 0.0) || !(light.brightness > 0.0)) return;
  face.squareness = product / squares;
  face.sigma_squareness = light.sigma / light.brightness * std::sqrt(kFaceCorrelation / squares);
}

}  // namespace pharos::tof
