// SPDX-License-Identifier: Apache-2.0
#include "host/calibrate/camera/coverage.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::calibrate {
namespace {

constexpr std::array<std::array<const char*, 3>, 3> kNinths{
    {{"upper left", "top", "upper right"}, {"left", "middle", "right"}, {"lower left", "bottom", "lower right"}}};

std::size_t part_of(double place, int size, int parts) {
  const int part = static_cast<int>(std::floor((place + 0.5) / size * parts));
  return static_cast<std::size_t>(std::clamp(part, 0, parts - 1));
}

}  // namespace

Coverage coverage_of(const std::vector<FoundBoard>& views, int width_px, int height_px) {
  Coverage coverage;
  std::array<std::array<int, 3>, 3> ninths{};
  const Vector2 middle(0.5 * (width_px - 1), 0.5 * (height_px - 1));
  for (const FoundBoard& view : views) {
    for (const FoundPoint& point : view.points) {
      const double u = point.pixel.x(), v = point.pixel.y();
      ++coverage.points[part_of(v, height_px, Coverage::kRows)][part_of(u, width_px, Coverage::kColumns)];
      ++ninths[part_of(v, height_px, 3)][part_of(u, width_px, 3)];
      coverage.reach = std::max(coverage.reach, (point.pixel - middle).norm() / middle.norm());
    }
  }
  for (const auto& row : coverage.points) {
    for (const int points : row) coverage.fraction += points > 0 ? 1.0 / (Coverage::kRows * Coverage::kColumns) : 0.0;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      if (ninths[row][column] == 0) coverage.uncovered.emplace_back(kNinths[row][column]);
    }
  }
  return coverage;
}

}  // namespace pharos::calibrate
