// SPDX-License-Identifier: Apache-2.0
#include "host/vision/enhance/bm3d.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "host/vision/enhance/alternate_bands.hpp"
#include "host/vision/enhance/block_match.hpp"
#include "host/vision/enhance/shrinkage.hpp"
#include "host/vision/enhance/wide_vectors.hpp"

namespace pharos::enhance {
namespace {

using Index = std::ptrdiff_t;
using Window = std::array<float, kBlockPixels>;

constexpr auto kSide = static_cast<std::int32_t>(kBlock_px);
// Rows of references in a band. Every second band is written at the same time; with the reach on both sides they must
// not overlap.
constexpr std::int32_t kBand_px = 64;
constexpr std::int32_t kMaxReach_px = (kBand_px - kSide) / 2;
// Step between blocks of the fast denoiser: 8 ms for 640x480.
constexpr std::int32_t kFastStep_px = 2;
// Largest mean absolute difference of stacked blocks: above that of equal blocks with noise (1.13 sigma).
constexpr float kAlikeNoisy = 0.17F, kAlikeClean = 0.11F;

// Kaiser's window with beta 2, in both dimensions.
Window kaiser() {
  constexpr double kBeta = 2.0;
  std::array<double, kBlock_px> line{};
  for (std::size_t k = 0; k < kBlock_px; ++k) {
    const double place = 2.0 * static_cast<double>(k) / static_cast<double>(kBlock_px - 1) - 1.0;
    line[k] = std::cyl_bessel_i(0.0, kBeta * std::sqrt(1.0 - place * place)) / std::cyl_bessel_i(0.0, kBeta);
  }
  Window window{};
  for (std::size_t k = 0; k < kBlockPixels; ++k) {
    window[k] = static_cast<float>(line[k / kBlock_px] * line[k % kBlock_px]);
  }
  return window;
}

// Aggregation of blocks: each pixel's weighted sum and the sum of its weights.
class Mosaic {
 public:
  void clear(std::int32_t width, std::int32_t height) {
    width_ = width;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    weighted_.assign(pixels, 0.0F);
    weights_.assign(pixels, 0.0F);
  }

  PHAROS_WIDE_VECTORS void add(const Stack& stack, std::span<const BlockPlace> places, float weight) {
    Window fraction;
    for (std::size_t k = 0; k < kBlockPixels; ++k) fraction[k] = weight * window_[k];
    const float* block = stack.data();
    for (const BlockPlace& place : places) {
      for (std::size_t y = 0; y < kBlock_px; ++y) {
        const auto at = static_cast<std::size_t>((place.v_px + static_cast<Index>(y)) * width_ + place.u_px);
        for (std::size_t x = 0; x < kBlock_px; ++x) {
          weighted_[at + x] += fraction[kBlock_px * y + x] * block[kBlock_px * y + x];
          weights_[at + x] += fraction[kBlock_px * y + x];
        }
      }
      block += kBlockPixels;
    }
  }

  void mean(FloatImage& out) const {
    for (std::size_t k = 0; k < weights_.size(); ++k) out.values[k] = weighted_[k] / weights_[k];
  }

 private:
  Window window_ = kaiser();
  Index width_ = 0;
  std::vector<float> weighted_, weights_;
};

// first, first + step, ... and last itself, so that every pixel is covered by a block.
template <class Each>
void each_place(std::int32_t first, std::int32_t last, std::int32_t step, Each&& each) {
  for (std::int32_t at = first; at < last; at += step) each(at);
  each(last);
}

// band(worker, first row of references, last row), neighbours never in parallel: no two threads add to the same pixel,
// and the order of sums is fixed.
template <class Band>
void over_bands(std::int32_t height_px, int threads, Band&& band) {
  const std::int32_t references = height_px - kSide + 1;
  alternate_bands((references + kBand_px - 1) / kBand_px, threads, [&](std::size_t worker, std::int32_t k) {
    band(worker, k * kBand_px, std::min((k + 1) * kBand_px, references) - 1);
  });
}

bool nothing_to_do(const FloatImage& image, double sigma) {
  return image.width_px < kSide || image.height_px < kSide || !(sigma > 0.0);
}

struct Pass {
  const FloatImage& noisy;
  const FloatImage& looked_at;  // image in which blocks are compared
  MatchSettings match;
  std::int32_t step_px;
  int threads;
};

// Filters one stack, from and to pixels; returns its weight.
PHAROS_WIDE_VECTORS float hard_step(const FloatImage& noisy, std::span<const BlockPlace> places, float sigma,
                                    Stack& stack) {
  gather<BlockTransform::kWavelet>(noisy.view(), places, stack);
  const float weight = shrink_hard(stack, places.size(), sigma);
  back_to_pixels<BlockTransform::kWavelet>(stack, places.size());
  return weight;
}

PHAROS_WIDE_VECTORS float wiener_step(const FloatImage& noisy, const FloatImage& first,
                                      std::span<const BlockPlace> places, float sigma, Stack& stack, Stack& pilot) {
  gather<BlockTransform::kCosine>(noisy.view(), places, stack);
  gather<BlockTransform::kCosine>(first.view(), places, pilot);
  const float weight = shrink_wiener(stack, pilot, places.size(), sigma);
  back_to_pixels<BlockTransform::kCosine>(stack, places.size());
  return weight;
}

PHAROS_WIDE_VECTORS float single_step(const FloatImage& noisy, std::span<const BlockPlace> place, float sigma,
                                      Stack& stack) {
  gather<BlockTransform::kCosine>(noisy.view(), place, stack);
  const float weight = shrink_hard(stack, 1, sigma);
  back_to_pixels<BlockTransform::kCosine>(stack, 1);
  return weight;
}

// One step of BM3D; step(places, stack) leaves the stack's pixels and returns its weight.
template <class Step>
void run(const Pass& pass, std::vector<BlockMatcher>& matchers, Mosaic& mosaic, Step&& step) {
  const FloatImage& noisy = pass.noisy;
  const auto extremes = std::minmax_element(pass.looked_at.values.begin(), pass.looked_at.values.end());
  const float low = *extremes.first, high = *extremes.second;
  matchers.resize(std::max(matchers.size(), static_cast<std::size_t>(std::max(1, pass.threads))));
  mosaic.clear(noisy.width_px, noisy.height_px);
  over_bands(noisy.height_px, pass.threads, [&](std::size_t worker, std::int32_t first, std::int32_t last) {
    BlockMatcher& matcher = matchers[worker];
    matcher.look_at(pass.looked_at.view(), std::max(0, first - pass.match.reach_px),
                    std::min(noisy.height_px, last + pass.match.reach_px + kSide), low, high);
    Stack stack;
    each_place(first, last, pass.step_px, [&](std::int32_t v) {
      each_place(0, noisy.width_px - kSide, pass.step_px, [&](std::int32_t u) {
        const std::span<const BlockPlace> places = matcher.find({u, v}, pass.match);
        const float weight = step(places, stack);
        mosaic.add(stack, places, weight);
      });
    });
  });
}

}  // namespace

struct BlockDenoiser::Buffers {
  Mosaic mosaic;
  FloatImage first;
  std::vector<BlockMatcher> matchers;
};

BlockDenoiser::BlockDenoiser() : buffers_(std::make_unique<Buffers>()) {}
BlockDenoiser::BlockDenoiser(BlockDenoiser&&) noexcept = default;
BlockDenoiser& BlockDenoiser::operator=(BlockDenoiser&&) noexcept = default;
BlockDenoiser::~BlockDenoiser() = default;

void BlockDenoiser::bm3d(const FloatImage& noisy, double sigma, const Bm3dSettings& settings, int threads,
                         FloatImage& out) {
  if (nothing_to_do(noisy, sigma)) {
    out = noisy;
    return;
  }
  Buffers& b = *buffers_;
  const auto level = static_cast<float>(sigma);
  const std::int32_t reach_px = std::clamp(settings.reach_px, 1, kMaxReach_px);
  const Pass hard{
      noisy, noisy, {reach_px, settings.hard_blocks, 1.13F * level + kAlikeNoisy}, settings.hard_step_px, threads};
  run(hard, b.matchers, b.mosaic,
      [&noisy, level](auto places, Stack& stack) { return hard_step(noisy, places, level, stack); });
  b.first.shape(noisy.width_px, noisy.height_px, 1);
  b.mosaic.mean(b.first);

  const Pass wiener{noisy, b.first, {reach_px, settings.wiener_blocks, kAlikeClean}, settings.wiener_step_px, threads};
  run(wiener, b.matchers, b.mosaic, [&noisy, &b, level](auto places, Stack& stack) {
    Stack pilot;
    return wiener_step(noisy, b.first, places, level, stack, pilot);
  });
  out.shape(noisy.width_px, noisy.height_px, 1);
  b.mosaic.mean(out);
}

void BlockDenoiser::thresholds(const FloatImage& noisy, double sigma, int threads, FloatImage& out) {
  if (nothing_to_do(noisy, sigma)) {
    out = noisy;
    return;
  }
  Mosaic& mosaic = buffers_->mosaic;
  mosaic.clear(noisy.width_px, noisy.height_px);
  over_bands(noisy.height_px, threads, [&](std::size_t, std::int32_t first, std::int32_t last) {
    Stack stack;
    each_place(first, last, kFastStep_px, [&](std::int32_t v) {
      each_place(0, noisy.width_px - kSide, kFastStep_px, [&](std::int32_t u) {
        const std::array<BlockPlace, 1> here = {BlockPlace{u, v}};
        const float weight = single_step(noisy, here, static_cast<float>(sigma), stack);
        mosaic.add(stack, here, weight);
      });
    });
  });
  out.shape(noisy.width_px, noisy.height_px, 1);
  mosaic.mean(out);
}

}  // namespace pharos::enhance
