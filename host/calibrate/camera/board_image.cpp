// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_image.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace pharos::calibrate {
namespace {

constexpr std::size_t kAngles = 8;
// Gauss-Legendre with two points in the squared radius, which weighs a disk's area evenly.
constexpr std::array<double, 2> kRadii{0.45970084338098305, 0.88807383397711526};

// Of a disk of radius 1.
std::array<Vector2, kRadii.size() * kAngles> places_on_disk() {
  std::array<Vector2, kRadii.size() * kAngles> places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i % kAngles) + 0.5) / kAngles;
    places[i] = kRadii[i / kAngles] * Vector2(std::cos(angle), std::sin(angle));
  }
  return places;
}

}  // namespace

ProjectedPoint project_board_point(const PinholeCamera& camera, const CameraFromBoard& T_camera_board,
                                   const Board& board, std::size_t index) {
  const Vector3 centre_m = T_camera_board * board.point_m(index);
  if (board.kind == BoardKind::kChessboard) return {distort(camera, centre_m.hnormalized()), 0.0};
  ProjectedPoint seen;
  const auto plane = T_camera_board.R.leftCols<2>();
  const double height_m = std::abs(T_camera_board.R.col(2).dot(centre_m));  // of the camera over the board's plane
  static const auto kPlaces = places_on_disk();
  for (const Vector2& place : kPlaces) {
    const Vector3 p_m = centre_m + plane * (board.radius_m * place);
    const Vector2 ray = p_m.hnormalized();
    // d pixel / d ray, times d ray / d place, whose determinant is height / z^3.
    const double area =
        std::abs(distort_jacobian(camera, ray).determinant()) * height_m / (p_m.z() * p_m.z() * p_m.z());
    seen.pixel += area * distort(camera, ray);
    seen.area_px2 += area;
  }
  seen.pixel /= seen.area_px2;
  seen.area_px2 *= std::numbers::pi * board.radius_m * board.radius_m / static_cast<double>(kPlaces.size());
  return seen;
}

}  // namespace pharos::calibrate
