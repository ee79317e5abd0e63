// SPDX-License-Identifier: Apache-2.0
#include "pharos/tof/local_threshold.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace pharos::tof {
namespace {

int mirrored(int index, int size) {
  while (index < 0 || index >= size) index = index < 0 ? -index : 2 * (size - 1) - index;
  return index;
}

// (5), pixel by pixel as it is written.
bool grows_as_written(const std::vector<std::uint16_t>& grey, int width, int height, int u, int v, int w,
                      ThresholdForm form) {
  const double here = grey[static_cast<std::size_t>(v * width + u)];
  if (here == 0.0) return false;
  std::vector<double> window;
  for (int j = -w; j <= w; ++j) {
    for (int i = -w; i <= w; ++i) {
      const double g = grey[static_cast<std::size_t>(mirrored(v + j, height) * width + mirrored(u + i, width))];
      if (g != 0.0) window.push_back(g);
    }
  }
  double mean = 0.0;
  for (const double g : window) mean += g / static_cast<double>(window.size());
  double squares = 0.0;
  for (const double g : window) squares += (g - mean) * (g - mean);
  const double divisor = form == ThresholdForm::kPixelCount ? static_cast<double>(window.size()) : mean;
  return here > mean - 0.2 * std::sqrt(squares / divisor);
}

class LocalThreshold : public testing::TestWithParam<ThresholdForm> {};

TEST_P(LocalThreshold, RunningSumsGiveWhatTheFormulaSays) {
  constexpr int kWidth = 37;
  constexpr int kHeight = 23;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> noise(-300, 300);
  std::vector<std::uint16_t> grey;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const int step = i % kWidth > 18 ? 2000 : 0;
    grey.push_back(i % 29 == 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(30000 + step + noise(random)));
  }
  const auto workspace = std::make_unique<ThresholdWorkspace>();
  const auto above = std::make_unique<BitImage>();
  for (const int w : {1, 4, 9, 24}) {  // the last one reaches over both borders
    local_threshold({grey.data(), kWidth, kHeight}, w, GetParam(), *workspace, *above);
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        ASSERT_EQ(above->at(u, v), grows_as_written(grey, kWidth, kHeight, u, v, w, GetParam()))
            << "w " << w << " at " << u << ", " << v;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothForms, LocalThreshold,
                         testing::Values(ThresholdForm::kPixelCount, ThresholdForm::kAsPrinted));

TEST(LocalThresholdForms, AFlatPatchOfNoiseGrowsOnlyByThePixelCount) {
  // On 16-bit data the printed form's deviation all but vanishes (it is divided by a mean of tens of thousands): half
  // of a flat, noisy face stays below its own mean. By the pixel count 58 % of it grows, Phi(0.2).
  constexpr int kSide = 200;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, 30.0);
  std::vector<std::uint16_t> grey;
  for (int i = 0; i < kSide * kSide; ++i) grey.push_back(static_cast<std::uint16_t>(33000.5 + noise(random)));
  const auto workspace = std::make_unique<ThresholdWorkspace>();
  const auto above = std::make_unique<BitImage>();
  const auto fraction = [&](ThresholdForm form) {
    local_threshold({grey.data(), kSide, kSide}, 4, form, *workspace, *above);
    int set = 0;
    for (int v = 0; v < kSide; ++v) {
      for (int u = 0; u < kSide; ++u) set += above->at(u, v) ? 1 : 0;
    }
    return static_cast<double>(set) / (kSide * kSide);
  };
  EXPECT_NEAR(fraction(ThresholdForm::kPixelCount), 0.58, 0.015);
  EXPECT_NEAR(fraction(ThresholdForm::kAsPrinted), 0.50, 0.015);
}

}  // namespace
}  // namespace pharos::tof
