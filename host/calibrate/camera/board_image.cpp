// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/board_image.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace pharos::calibrate {
namespace {

constexpr int kAngles = 8;
// Gauss-Legendre with two points in the squared radius, which weighs a disk's area evenly.
constexpr std::array<double, 2> kRadii{0.45970084338098305, 0.88807383397711526};

}  // namespace

ProjectedPoint project_board_point(const PinholeCamera& camera, const CameraFromBoard& T_camera_board,
                                   const Board& board, std::size_t index) {
  const Vector3 centre_m = T_camera_board * board.point_m(index);
  if (board.kind == BoardKind::kChessboard) return {distort(camera, centre_m.hnormalized()), 0.0};
  ProjectedPoint seen;
  const auto plane = T_camera_board.R.leftCols<2>();
  for (const double radius : kRadii) {
    for (int k = 0; k < kAngles; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k + 0.5) / kAngles;
      const Vector2 on_disk_m = board.radius_m * radius * Vector2(std::cos(angle), std::sin(angle));
      const Vector3 p_m = centre_m + plane * on_disk_m;
      const double area = std::abs((project_jacobian(camera, p_m) * plane).determinant());
      seen.pixel += area * distort(camera, p_m.hnormalized());
      seen.area_px2 += area;
    }
  }
  seen.pixel /= seen.area_px2;
  seen.area_px2 *= std::numbers::pi * board.radius_m * board.radius_m / static_cast<double>(kRadii.size() * kAngles);
  return seen;
}

}  // namespace pharos::calibrate
