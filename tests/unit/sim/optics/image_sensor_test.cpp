// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/image_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace pharos::sim {
namespace {

struct Moments {
  double mean = 0.0;
  double sigma = 0.0;
};

// Of a uniform grey, in electrons.
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

TEST(ImageSensor, WithoutShotNoiseOnlyReadingIsNoise) {
  const Moments moments = exposed(0.5F, {.read_noise_e = 20.0, .bits = 16, .shot_noise = false});
  EXPECT_NEAR(moments.mean, 4000.0, 0.5);
  EXPECT_NEAR(moments.sigma, 20.0, 0.3);
}

TEST(ImageSensor, EightBitsRoundToTheNearestCountAndComeAsReadFromAFile) {
  // 10 of 255 counts are 392.2 electrons of the well.
  const LinearImage image{2, 1, {390.0F / 8000.0F, 415.0F / 8000.0F}};
  RandomStream random(1, "sensor");
  const host::GreyImage grey = expose(image, {.read_noise_e = 0.0, .bits = 8, .shot_noise = false}, random);
  EXPECT_EQ(grey.bits, 8);
  EXPECT_EQ(grey.pixels[0], 10 * 257);
  EXPECT_EQ(grey.pixels[1], 11 * 257);
}

TEST(PeakLight, IgnoresGlints) {
  LinearImage image{100, 100, std::vector<float>(10000, 0.4F)};
  for (int i = 0; i < 9; ++i) image.light[static_cast<std::size_t>(i * 1000)] = 1.0F;
  EXPECT_FLOAT_EQ(static_cast<float>(peak_light(image)), 0.4F);
}

TEST(PeakLight, OfTheLitPixelsIsThatOfAThingHoweverSmallItStandsInTheImage) {
  LinearImage image{100, 100, std::vector<float>(10000, 0.0F)};
  image.at(50, 50) = 0.7F;
  EXPECT_EQ(peak_light(image), 0.0);
  EXPECT_FLOAT_EQ(static_cast<float>(peak_light(image, true)), 0.7F);
  EXPECT_EQ(peak_light({2, 1, {0.0F, 0.0F}}, true), 0.0);
}

}  // namespace
}  // namespace pharos::sim
