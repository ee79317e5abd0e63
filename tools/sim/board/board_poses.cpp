// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/board/board_poses.hpp"

#include <cmath>
#include <numbers>

#include "pharos/geometry/rotation.hpp"
#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

constexpr double kLargestTilt_rad = 40.0 * std::numbers::pi / 180.0;
constexpr double kLargestRoll_rad = 20.0 * std::numbers::pi / 180.0;
// Of the image's width, that the board's columns span when it faces the camera.
constexpr double kSmallestSpan = 0.35;
constexpr double kLargestSpan = 0.85;
constexpr int kMaxTries = 100000;

}  // namespace

bool shows_all_of(const Lens& lens, const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T) {
  for (const double column : {-1.0, 0.5 * (sheet.columns - 1), static_cast<double>(sheet.columns)}) {
    for (const double row : {-1.0, 0.5 * (sheet.rows - 1), static_cast<double>(sheet.rows)}) {
      const Vector2 seen = pixel_of(lens, T * Vector3(column * sheet.pitch_m, row * sheet.pitch_m, 0.0));
      if (seen.x() < 0.0 || seen.y() < 0.0 || seen.x() > lens.width_px - 1 || seen.y() > lens.height_px - 1)
        return false;
    }
  }
  return true;
}

Pose<frame::Camera, frame::Board> board_at(const BoardSheet& sheet, const Vector3& middle_m, const Vector3& tilt_rad,
                                           double roll_rad) {
  const Matrix3 R = rotation_exp(tilt_rad) * rotation_exp({0.0, 0.0, roll_rad});
  const Vector3 middle_board(0.5 * (sheet.columns - 1) * sheet.pitch_m, 0.5 * (sheet.rows - 1) * sheet.pitch_m, 0.0);
  return {R, middle_m - R * middle_board};
}

std::vector<Pose<frame::Camera, frame::Board>> board_poses(const Lens& lens, const BoardSheet& sheet, int count,
                                                           std::uint64_t seed) {
  RandomStream random(seed, "board poses");
  std::vector<Pose<frame::Camera, frame::Board>> poses;
  for (int tries = 0; tries < kMaxTries && static_cast<int>(poses.size()) < count; ++tries) {
    const double width_m = (sheet.columns - 1) * sheet.pitch_m;
    const double z = lens.fx_px * width_m / (random.uniform(kSmallestSpan, kLargestSpan) * lens.width_px);
    const Vector3 middle(z * (random.uniform(0.0, lens.width_px) - lens.cx_px) / lens.fx_px,
                         z * (random.uniform(0.0, lens.height_px) - lens.cy_px) / lens.fy_px, z);
    const double tilt = random.uniform(0.0, kLargestTilt_rad), way = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3 tilt_rad(tilt * std::cos(way), tilt * std::sin(way), 0.0);
    const auto T = board_at(sheet, middle, tilt_rad, random.uniform(-kLargestRoll_rad, kLargestRoll_rad));
    if (shows_all_of(lens, sheet, T)) poses.push_back(T);
  }
  return poses;
}

}  // namespace pharos::sim
