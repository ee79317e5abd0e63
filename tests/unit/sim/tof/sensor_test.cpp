// SPDX-License-Identifier: Apache-2.0
// The noise is as stated in README.md.
#include "tools/sim/tof/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pharos::sim {
namespace {

const PixelRays& sensor_rays() {
  static const PixelRays kRays({160, 120, kPaperLens.fx_px, kPaperLens.fy_px, 80.0, 60.0, kPaperLens.distortion});
  return kRays;
}
constexpr std::size_t kPixels = 160 * 120;
constexpr double kNominal = 8000.0;
const DepthScale kFine{.scale_m = 0.0001};

IdealFrame even(double counts, double range_m) {
  return {std::vector<float>(kPixels, static_cast<float>(counts)),
          std::vector<float>(kPixels, static_cast<float>(range_m))};
}

TofPixels exposed(const IdealFrame& ideal, const SensorModel& sensor, std::uint64_t seed = 1) {
  return expose(ideal, sensor_rays(), sensor, kNominal, kFine, RandomStream(seed, "sensor test"));
}

// Range errors.
std::vector<double> errors(const TofPixels& pixels, double range_m) {
  std::vector<double> result;
  for (std::size_t i = 0; i < kPixels; ++i) {
    const int u = static_cast<int>(i % 160);
    const int v = static_cast<int>(i / 160);
    result.push_back(pixels.depth[i] * kFine.scale_m * sensor_rays().range_per_depth(u, v) - range_m);
  }
  return result;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Covariance of errors at a distance of `apart` columns.
double covariance(const std::vector<double>& error, int apart) {
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u + apart < 160; ++u) {
      const auto i = static_cast<std::size_t>(v * 160 + u);
      sum += error[i] * error[i + static_cast<std::size_t>(apart)];
      ++count;
    }
  }
  return sum / count;
}

SensorModel without_common() {
  SensorModel sensor;
  sensor.common_sigma_m = 0.0;
  return sensor;
}

TEST(Sensor, DepthNoiseIsTheStatedOneAtNominalAmplitude) {
  const std::vector<double> error = errors(exposed(even(kNominal, 3.16), without_common()), 3.16);
  EXPECT_NEAR(std::sqrt(covariance(error, 0)), 0.004, 0.0002);
}

TEST(Sensor, DepthNoiseGrowsAsAmplitudeFalls) {
  const std::vector<double> error = errors(exposed(even(kNominal / 4.0, 4.0), without_common()), 4.0);
  EXPECT_NEAR(std::sqrt(covariance(error, 0)), 0.016, 0.0008);
}

TEST(Sensor, DepthNoiseIsCorrelatedOverTheStatedDistance) {
  // Over many frames; exp(-distance^2 / 1.5^2).
  std::vector<double> correlation(4, 0.0);
  double variance = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<double> error = errors(exposed(even(kNominal, 3.16), without_common(), seed), 3.16);
    variance += covariance(error, 0);
    for (int apart = 1; apart < 4; ++apart) correlation[static_cast<std::size_t>(apart)] += covariance(error, apart);
  }
  for (int apart = 1; apart < 4; ++apart) {
    const double expected = std::exp(-apart * apart / 2.25);
    EXPECT_NEAR(correlation[static_cast<std::size_t>(apart)] / variance, expected, 0.02) << apart;
  }
}

TEST(Sensor, AFramesDepthsMoveTogether) {
  SensorModel sensor;
  sensor.sigma_nominal_m = 0.0;
  double squares = 0.0;
  constexpr std::uint64_t kFrames = 300;
  for (std::uint64_t seed = 0; seed < kFrames; ++seed) {
    const double offset = mean(errors(exposed(even(kNominal, 3.0), sensor, seed), 3.0));
    squares += offset * offset;
  }
  EXPECT_NEAR(std::sqrt(squares / kFrames), 0.0003, 0.00005);
}

TEST(Sensor, IntensityHasShotAndReadNoise) {
  const TofPixels pixels = exposed(even(2000.0, 3.0), SensorModel{});
  double sum = 0.0;
  double squares = 0.0;
  for (const std::uint16_t value : pixels.intensity) {
    sum += value;
    squares += static_cast<double>(value) * value;
  }
  const double average = sum / kPixels;
  EXPECT_NEAR(average, 2000.0, 2.0);
  EXPECT_NEAR(squares / kPixels - average * average, 2000.0 / 1.25 + 15.0 * 15.0, 80.0);
}

TEST(Sensor, WeakAndSaturatedPixelsHaveNoDepth) {
  const TofPixels weak = exposed(even(100.0, 3.0), SensorModel{});
  const TofPixels saturated = exposed(even(65000.0, 3.0), SensorModel{});
  for (std::size_t i = 0; i < kPixels; ++i) {
    ASSERT_EQ(weak.depth[i], 0);
    ASSERT_EQ(saturated.depth[i], 0);
    ASSERT_EQ(saturated.intensity[i], 65535);
  }
}

TEST(Sensor, RangeBeginsAgainBeyondTheLimit) {
  SensorModel sensor;
  sensor.range_limit_m = 4.0;
  EXPECT_NEAR(mean(errors(exposed(even(kNominal, 4.6), sensor), 0.6)), 0.0, 0.002);
  EXPECT_NEAR(mean(errors(exposed(even(kNominal, 3.4), sensor), 3.4)), 0.0, 0.002);
}

TEST(Sensor, DepthCountsFromTheGivenOrigin) {
  const DepthScale from_front{.scale_m = 0.00025, .origin_z_m = 0.05};
  SensorModel sensor;
  sensor.sigma_nominal_m = sensor.common_sigma_m = 0.0;
  const TofPixels pixels =
      expose(even(kNominal, 3.0), sensor_rays(), sensor, kNominal, from_front, RandomStream(1, "sensor test"));
  EXPECT_NEAR(pixels.depth[60 * 160 + 80] * 0.00025, 3.0 - 0.05, 0.0002);
}

TEST(Sensor, NormalNumbersHaveTheMomentsAndTailsOfANormalDistribution) {
  std::vector<float> values(1 << 18);
  RandomStream random(5, "normals");
  fill_normal(values, random);
  double sum = 0.0;
  double squares = 0.0;
  int beyond3 = 0;
  for (const float value : values) {
    sum += static_cast<double>(value);
    squares += static_cast<double>(value) * static_cast<double>(value);
    if (std::abs(value) > 3.0F) ++beyond3;
  }
  const double count = static_cast<double>(values.size());
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(squares / count, 1.0, 0.015);
  EXPECT_NEAR(beyond3 / count, 0.0027, 0.0005);
}

}  // namespace
}  // namespace pharos::sim
