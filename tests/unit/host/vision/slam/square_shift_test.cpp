// SPDX-License-Identifier: Apache-2.0
#include "host/vision/slam/square_shift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace pharos::slam {
namespace {

constexpr int kWidth_px = 64, kHeight_px = 32;

// Smooth random brightness along a surface.
class Texture {
 public:
  explicit Texture(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> wave(-1.2, 1.2), phase(0.0, 6.3);
    for (auto& part : parts_) part = {wave(random), wave(random), phase(random)};
  }
  double at(double u, double v) const {
    double sum = 0.0;
    for (const auto& [along_u, along_v, phase] : parts_) sum += std::sin(along_u * u + along_v * v + phase);
    return 120.0 + 15.0 * sum;
  }

 private:
  struct Part {
    double along_u, along_v, phase;
  };
  std::array<Part, 6> parts_{};
};

// A near surface up to column `edge_px` of the left image, before a far one.
struct TwoSurfaces {
  Texture near, far;
  double edge_px = 0.0, near_px = 0.0, far_px = 0.0;  // the last two are disparities

  std::vector<std::uint8_t> seen(bool right) const {
    constexpr int kRays = 8;
    std::vector<std::uint8_t> image;
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        double sum = 0.0;
        for (int k = 0; k < kRays; ++k) {
          const double at = u + (k + 0.5) / kRays - 0.5;
          const double on_near = right ? at + near_px : at, on_far = right ? at + far_px : at;
          sum += on_near < edge_px ? near.at(on_near, v) : far.at(on_far, v);
        }
        image.push_back(static_cast<std::uint8_t>(std::lround(sum / kRays)));
      }
    }
    return image;
  }
};

// Errors of the near surface's column over many textures, with its edge so far to the right of the square's middle.
struct Errors {
  double rms_px = 0.0;
  int found = 0;
};

Errors errors_beside_edge(double edge_off_px) {
  constexpr int kTextures = 60, kU = 40, kV = 16;
  Errors out;
  double squares = 0.0;
  for (std::uint64_t k = 0; k < kTextures; ++k) {
    const TwoSurfaces scene{Texture(2 * k + 1), Texture(2 * k + 2), kU + edge_off_px,
                            12.3 + 0.01 * static_cast<double>(k), 8.6};
    const auto left = scene.seen(false), right = scene.seen(true);
    const double column = std::round(kU - scene.near_px);
    const auto shift =
        square_shift({left.data(), kWidth_px, kHeight_px}, {right.data(), kWidth_px, kHeight_px}, kU, kV, column);
    if (!shift) continue;
    const double error = column + static_cast<double>((*shift)[1]) - (kU - scene.near_px);
    squares += error * error;
    ++out.found;
  }
  out.rms_px = std::sqrt(squares / std::max(1, out.found));
  return out;
}

TEST(SquareShift, OfOneSurfaceIsRightToHundredthsOfAPixel) {
  const Errors errors = errors_beside_edge(20.0);
  EXPECT_EQ(errors.found, 60);
  EXPECT_LT(errors.rms_px, 0.02);
}

TEST(SquareShift, OfTwoSurfacesIsThatOfTheOneInItsMiddle) {
  for (const double edge_off_px : {3.5, 2.5}) {
    const Errors errors = errors_beside_edge(edge_off_px);
    EXPECT_GE(errors.found, 50) << edge_off_px;
    EXPECT_LT(errors.rms_px, 0.04) << edge_off_px;
  }
}

}  // namespace
}  // namespace pharos::slam
