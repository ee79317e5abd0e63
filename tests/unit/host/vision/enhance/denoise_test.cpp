// SPDX-License-Identifier: Apache-2.0
// BM3D, its transforms, the fast denoiser and the noise level.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <latch>
#include <random>
#include <stdexcept>

#include "host/vision/enhance/alternate_bands.hpp"
#include "host/vision/enhance/block_transform.hpp"
#include "host/vision/enhance/bm3d.hpp"
#include "host/vision/enhance/noise_level.hpp"
#include "unit/host/vision/enhance/test_images.hpp"

namespace pharos::enhance {
namespace {

constexpr double kSigma = 15.0 / 255.0;

std::array<float, kBlockPixels> random_block() {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::array<float, kBlockPixels> block;
  for (float& value : block) value = normal(random);
  return block;
}

template <BlockTransform kind>
void comes_back() {
  const std::array<float, kBlockPixels> block = random_block();
  std::array<float, kBlockPixels> there;
  forward_transform<kind>(block.data(), kBlock_px, there.data());
  inverse_transform<kind>(there.data());
  for (std::size_t k = 0; k < kBlockPixels; ++k) EXPECT_NEAR(there[k], block[k], 1e-5F);
}

TEST(AlternateBands, AllAreDoneOnceAndEvenOnesFirst) {
  for (const int threads : {0, 1, 2, 5}) {
    std::array<std::atomic<int>, 7> done{};
    alternate_bands(7, threads, [&](std::size_t, std::int32_t k) {
      if (k % 2 == 1) {
        for (std::size_t even = 0; even < 7; even += 2) EXPECT_EQ(done[even], 1) << k;
      }
      ++done[static_cast<std::size_t>(k)];
    });
    for (const auto& count : done) EXPECT_EQ(count, 1) << threads;
  }
  alternate_bands(0, 2, [](std::size_t, std::int32_t) { FAIL() << "no band there"; });
}

// The caller's own band ends only after the other thread's has begun, which throws.
TEST(AlternateBands, WhatAnotherThreadThrowsComesToTheCaller) {
  std::latch begun(1);
  const auto band = [&begun](std::size_t worker, std::int32_t k) {
    EXPECT_EQ(k % 2, 0) << "bands go on after a fault";
    if (worker == 0) {
      begun.wait();
    } else {
      begun.count_down();
      throw std::runtime_error("no memory");
    }
  };
  EXPECT_THROW(alternate_bands(4, 2, band), std::runtime_error);
}

TEST(BlockTransforms, ComeBack) {
  comes_back<BlockTransform::kCosine>();
  comes_back<BlockTransform::kWavelet>();
}

// The DCT-II by its definition.
TEST(BlockTransforms, CosineIsTheOrthonormalDct) {
  const std::array<float, kBlockPixels> block = random_block();
  std::array<float, kBlockPixels> found;
  forward_transform<BlockTransform::kCosine>(block.data(), kBlock_px, found.data());
  const auto basis = [](int frequency, int place) {
    const double scale = frequency == 0 ? std::sqrt(1.0 / 8.0) : std::sqrt(2.0 / 8.0);
    return scale * std::cos(M_PI * (2 * place + 1) * frequency / 16.0);
  };
  for (int across = 0; across < 8; ++across) {
    for (int down = 0; down < 8; ++down) {
      double wanted = 0.0;
      for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
          wanted += basis(across, x) * basis(down, y) * static_cast<double>(block[static_cast<std::size_t>(8 * y + x)]);
        }
      }
      EXPECT_NEAR(static_cast<double>(found[static_cast<std::size_t>(8 * across + down)]), wanted, 1e-5);
    }
  }
}

TEST(BlockTransforms, NoiseKeepsItsLevelUnderTheWavelet) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  std::array<double, kBlockPixels> power{};
  constexpr int kBlocks = 20000;
  for (int k = 0; k < kBlocks; ++k) {
    std::array<float, kBlockPixels> block, there;
    for (float& value : block) value = normal(random);
    forward_transform<BlockTransform::kWavelet>(block.data(), kBlock_px, there.data());
    for (std::size_t i = 0; i < kBlockPixels; ++i) power[i] += static_cast<double>(there[i] * there[i]) / kBlocks;
  }
  for (const double value : power) EXPECT_NEAR(value, 1.0, 0.06);
}

TEST(BlockTransforms, HadamardTwiceIsTheNumberOfBlocks) {
  std::array<float, 16 * kBlockPixels> blocks;
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (float& value : blocks) value = normal(random);
  auto twice = blocks;
  hadamard(twice.data(), 16);
  hadamard(twice.data(), 16);
  for (std::size_t k = 0; k < blocks.size(); ++k) EXPECT_NEAR(twice[k], 16.0F * blocks[k], 1e-3F);
}

class Denoising : public testing::Test {
 protected:
  Denoising() : clean_(test::painted_target(200, 150, 0.8F)), noisy_(clean_) { test::add_noise(noisy_, kSigma, 11); }
  double gain_db(const FloatImage& quiet) const {
    return 20.0 * std::log10(test::rms_difference(noisy_, clean_) / test::rms_difference(quiet, clean_));
  }
  FloatImage clean_, noisy_, quiet_;
  BlockDenoiser denoiser_;
};

TEST_F(Denoising, Bm3dTakesMostOfTheNoiseAndTheQuickOnesLess) {
  denoiser_.bm3d(noisy_, kSigma, {}, 2, quiet_);
  const double full = gain_db(quiet_);
  denoiser_.bm3d(noisy_, kSigma, kVideoBm3d, 2, quiet_);
  const double video = gain_db(quiet_);
  denoiser_.thresholds(noisy_, kSigma, 2, quiet_);
  const double fast = gain_db(quiet_);
  EXPECT_GT(full, 10.0);
  EXPECT_GT(video, full - 1.5);
  EXPECT_GT(full, video);
  EXPECT_GT(video, fast);
  EXPECT_GT(fast, 5.0);
}

// Averaging of blocks preserves the mean.
TEST_F(Denoising, BiasIsSmall) {
  denoiser_.bm3d(noisy_, kSigma, {}, 1, quiet_);
  double before = 0.0, after = 0.0;
  for (const float value : noisy_.values) before += static_cast<double>(value);
  for (const float value : quiet_.values) after += static_cast<double>(value);
  EXPECT_NEAR(after, before, 2e-3 * before);
}

TEST_F(Denoising, AnyNumberOfThreadsGivesTheSameBits) {
  FloatImage one, three;
  BlockDenoiser other;
  denoiser_.bm3d(noisy_, kSigma, {}, 1, one);
  other.bm3d(noisy_, kSigma, {}, 3, three);
  EXPECT_EQ(one.values, three.values);
  denoiser_.thresholds(noisy_, kSigma, 1, one);
  other.thresholds(noisy_, kSigma, 3, three);
  EXPECT_EQ(one.values, three.values);
}

TEST_F(Denoising, WithoutNoiseNothingChanges) {
  denoiser_.bm3d(noisy_, 0.0, {}, 2, quiet_);
  EXPECT_EQ(quiet_.values, noisy_.values);
  denoiser_.bm3d(clean_, 1e-6, {}, 2, quiet_);
  EXPECT_LT(test::rms_difference(quiet_, clean_), 1e-5);
}

TEST(BlockDenoiserTest, TakesImagesOfAnySize) {
  BlockDenoiser denoiser;
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 20}, {8, 8}, {9, 70}, {130, 8}}) {
    FloatImage image = test::painted_target(width, height, 1.0F), quiet;
    test::add_noise(image, kSigma, 2);
    denoiser.bm3d(image, kSigma, {}, 2, quiet);
    ASSERT_EQ(quiet.values.size(), image.values.size());
    for (const float value : quiet.values) ASSERT_TRUE(std::isfinite(value)) << width << 'x' << height;
  }
}

TEST(NoiseLevel, IsFoundWithinATenth) {
  for (const double sigma : {2.0 / 255.0, 5.0 / 255.0, 15.0 / 255.0, 30.0 / 255.0}) {
    FloatImage image;
    image.shape(320, 240, 1);
    for (std::int32_t v = 0; v < 240; ++v) {
      for (std::int32_t u = 0; u < 320; ++u) {
        const float x = static_cast<float>(u), y = static_cast<float>(v);
        image.view().at(u, v) = 0.5F + 0.1F * std::sin(0.05F * x) + (u > 160 ? 0.1F * std::sin(0.9F * x + y) : 0.0F);
      }
    }
    test::add_noise(image, sigma, 4);
    const FloatImage& read_only = image;
    EXPECT_NEAR(noise_level(read_only.view()), sigma, 0.1 * sigma);
  }
}

TEST(NoiseLevel, FlatBlackAndWhiteImagesHaveNone) {
  for (const float value : {0.0F, 0.5F, 1.0F}) {
    FloatImage image;
    image.shape(64, 64, 1);
    std::fill(image.values.begin(), image.values.end(), value);
    const FloatImage& read_only = image;
    EXPECT_EQ(noise_level(read_only.view()), 0.0);
  }
}

}  // namespace
}  // namespace pharos::enhance
