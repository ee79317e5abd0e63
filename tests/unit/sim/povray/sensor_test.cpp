// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace pharos::sim {
namespace {

struct Moments {
  double mean = 0.0;
  double sigma = 0.0;
};

// Of an even grey, in electrons.
Moments exposed(float light, const ImageSensor& sensor) {
  LinearImage image{200, 200, std::vector<float>(40000, light)};
  RandomStream random(3, "sensor");
  const host::GreyImage grey = expose(image, sensor, random);
  Moments moments;
  for (const std::uint16_t value : grey.pixels) moments.mean += value / 65535.0 * sensor.full_well_e / 40000.0;
  for (const std::uint16_t value : grey.pixels) {
    const double off = value / 65535.0 * sensor.full_well_e - moments.mean;
    moments.sigma += off * off / 40000.0;
  }
  moments.sigma = std::sqrt(moments.sigma);
  return moments;
}

TEST(ImageSensor, NoiseIsThatOfElectronsAndReading) {
  const ImageSensor sensor{.bits = 16};
  const Moments bright = exposed(1.0F, sensor);
  EXPECT_NEAR(bright.mean, 8000.0, 3.0);
  EXPECT_NEAR(bright.sigma, std::sqrt(8000.0 + 36.0), 1.5);
  const Moments dim = exposed(0.004F, sensor);
  EXPECT_NEAR(dim.mean, 32.0, 0.3);
  EXPECT_NEAR(dim.sigma, std::sqrt(32.0 + 36.0), 0.3);
}

TEST(ImageSensor, AFullWellIsTheLargestCount) {
  LinearImage image{1, 1, {100.0F}};
  RandomStream random(1, "sensor");
  EXPECT_EQ(expose(image, {.read_noise_e = 0.0, .bits = 8}, random).pixels[0], 65535);
  EXPECT_EQ(expose(image, {.read_noise_e = 0.0, .bits = 16}, random).pixels[0], 65535);
}

TEST(Blur, KeepsLightAndSpreadsItAsAsked) {
  LinearImage image{41, 31, std::vector<float>(41 * 31, 0.0F)};
  image.at(20, 15) = 1.0F;
  const LinearImage soft = blurred(image, 1.5);
  double total = 0.0;
  double square = 0.0;
  for (std::int32_t v = 0; v < 31; ++v) {
    for (std::int32_t u = 0; u < 41; ++u) {
      total += static_cast<double>(soft.at(u, v));
      square += static_cast<double>(soft.at(u, v)) * (u - 20) * (u - 20);
    }
  }
  EXPECT_NEAR(total, 1.0, 1e-5);
  EXPECT_NEAR(square, 1.5 * 1.5 + 1.0 / 12.0, 0.01);  // the pixel's own width adds 1/12
}

TEST(Blur, PeakLightIgnoresGlints) {
  LinearImage image{100, 100, std::vector<float>(10000, 0.4F)};
  for (int i = 0; i < 9; ++i) image.light[static_cast<std::size_t>(i * 1000)] = 1.0F;
  EXPECT_FLOAT_EQ(static_cast<float>(peak_light(image)), 0.4F);
}

}  // namespace
}  // namespace pharos::sim
