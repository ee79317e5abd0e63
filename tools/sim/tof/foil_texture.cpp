// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/foil_texture.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace pharos::sim {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Whole numbers of waves over the side in x and y, so that the pattern closes.
struct FoldedWave {
  int across = 0;
  int along = 0;
  double phase = 0.0;  // of one wave
  double height = 0.0;

  double at(double x, double y) const {
    const double turns = across * x + along * y + phase;
    const double part = turns - std::floor(turns);
    return height * (4.0 * std::abs(part - 0.5) - 1.0);
  }
};

constexpr int kWaves = 16;
constexpr double kLongest = 6.0;    // waves over the side: 0.34 m
constexpr double kShortest = 42.0;  // 0.05 m
constexpr double kBend = 0.02;      // of the side, by which creases leave straight lines

std::array<FoldedWave, kWaves> draw_waves(RandomStream& random) {
  std::array<FoldedWave, kWaves> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double count = kLongest * std::pow(kShortest / kLongest, i / (kWaves - 1.0));
    const double direction = random.uniform(0.0, kTurn);
    FoldedWave& wave = waves[static_cast<std::size_t>(i)];
    wave.across = static_cast<int>(std::lround(count * std::cos(direction)));
    wave.along = static_cast<int>(std::lround(count * std::sin(direction)));
    wave.phase = random.uniform();
    wave.height = 1.0 / count;  // every length as steep
  }
  return waves;
}

}  // namespace

FoilTexture::FoilTexture(double height_m, RandomStream random) {
  const std::array<FoldedWave, kWaves> waves = draw_waves(random);
  const double phase_x = random.uniform(0.0, kTurn);
  const double phase_y = random.uniform(0.0, kTurn);
  constexpr std::size_t kCount = std::size_t{kCells} * kCells;
  std::vector<double> height(kCount);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double x = static_cast<double>(i % kCells) / kCells;
    const std::size_t row = i / kCells;
    const double y = static_cast<double>(row) / kCells;
    const double bent_x = x + kBend * std::sin(kTurn * 3.0 * y + phase_x);
    const double bent_y = y + kBend * std::sin(kTurn * 2.0 * x + phase_y);
    for (const FoldedWave& wave : waves) height[i] += wave.at(bent_x, bent_y);
    sum += height[i];
    squares += height[i] * height[i];
  }
  const double mean = sum / kCount;
  const double scale = height_m / std::sqrt(squares / kCount - mean * mean);
  std::vector<Sample> grid(kCount);
  const auto level = [&](std::size_t column, std::size_t row) {
    return scale * (height[(row % kCells) * kCells + column % kCells] - mean);
  };
  constexpr double kTwoCells_m = 2.0 * kSide_m / kCells;
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      Sample& sample = grid[row * kCells + column];
      sample.height_m = static_cast<float>(level(column, row));
      sample.slope_x = static_cast<float>((level(column + 1, row) - level(column + kCells - 1, row)) / kTwoCells_m);
      sample.slope_y = static_cast<float>((level(column, row + 1) - level(column, row + kCells - 1)) / kTwoCells_m);
    }
  }
  grid_ = std::make_shared<const std::vector<Sample>>(std::move(grid));
}

FoilTexture::FoilTexture(const FoilTexture& pattern, double times, double x_m, double y_m) : FoilTexture(pattern) {
  times_ *= times;
  x_m_ += x_m;
  y_m_ += y_m;
}

FoilTexture::Wrinkle FoilTexture::at(double x_m, double y_m) const {
  constexpr double kPerMetre = kCells / kSide_m;
  constexpr int kMask = kCells - 1;
  const double x = (x_m + x_m_) * kPerMetre;
  const double y = (y_m + y_m_) * kPerMetre;
  const std::vector<Sample>& grid = *grid_;
  const double left = std::floor(x);
  const double top = std::floor(y);
  const auto fx = static_cast<float>(x - left);
  const auto fy = static_cast<float>(y - top);
  const int column = static_cast<int>(left);
  const int row = static_cast<int>(top);
  const auto cell = [&](int c, int r) -> const Sample& {
    return grid[static_cast<std::size_t>((r & kMask) * kCells + (c & kMask))];
  };
  const Sample& a = cell(column, row);
  const Sample& b = cell(column + 1, row);
  const Sample& c = cell(column, row + 1);
  const Sample& d = cell(column + 1, row + 1);
  const auto mix = [this, fx, fy](float p, float q, float r, float s) {
    const float upper = p + fx * (q - p);
    return times_ * static_cast<double>(upper + fy * (r + fx * (s - r) - upper));
  };
  return {mix(a.height_m, b.height_m, c.height_m, d.height_m), mix(a.slope_x, b.slope_x, c.slope_x, d.slope_x),
          mix(a.slope_y, b.slope_y, c.slope_y, d.slope_y)};
}

}  // namespace pharos::sim
