// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_enhance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "host/images/picture.hpp"
#include "host/support/input_error.hpp"
#include "host/vision/enhance/enhancer.hpp"
#include "host/vision/enhance/luma.hpp"
#include "host/vision/enhance/noise_level.hpp"
#include "tools/evaluation/bench/bench_dark_views.hpp"
#include "tools/evaluation/bench/exact_illumination.hpp"
#include "tools/evaluation/low_light/low_light_peers.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

using enhance::FloatImage;

constexpr std::int32_t kWidth = 640, kHeight = 480;
constexpr double kEnhance_ms = 1e3;
constexpr double kSigma = 15.0;  // of 255
constexpr int kEnhanceRepeats = 3;

// The central part of an image in grey, quantised to 8 bits.
FloatImage middle_of_file(const std::string& path) {
  const host::Picture picture = host::read_picture(path);
  if (picture.width_px < kWidth || picture.height_px < kHeight) throw host::InputError(path + ": less than 640 x 480");
  FloatImage whole, luma, cut;
  whole.shape(picture.width_px, picture.height_px, picture.channels);
  for (std::size_t k = 0; k < picture.values.size(); ++k) {
    const auto channels = static_cast<std::size_t>(picture.channels);
    whole.plane(static_cast<int>(k % channels))[k / channels] = static_cast<float>(picture.values[k]) / 65535.0F;
  }
  enhance::luma_of(whole, luma);
  cut.shape(kWidth, kHeight, 1);
  const std::int32_t u0 = (picture.width_px - kWidth) / 2, v0 = (picture.height_px - kHeight) / 2;
  for (std::int32_t v = 0; v < kHeight; ++v) std::copy_n(luma.view().row(v0 + v) + u0, kWidth, cut.view().row(v));
  return cut;
}

std::vector<std::uint8_t> bytes_of(const FloatImage& image) {
  std::vector<std::uint8_t> bytes(image.pixels());
  enhance::to_integers(image.view(), ImageView<std::uint8_t>(bytes.data(), image.width_px, image.height_px));
  return bytes;
}

double psnr_db(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(a.size()) / sum);
}

template <class Work>
double best_seconds(Work&& work) {
  double best = 1e9;
  for (int k = 0; k < kEnhanceRepeats; ++k) best = std::min(best, processor_seconds_of(work));
  return best;
}

// The illumination of a darkened image: without start value, from a frame shifted by two pixels, and exactly.
void add_illumination(const std::string& name, const FloatImage& image, std::vector<BenchRow>& rows) {
  FloatImage dark = image, before = image;
  for (std::size_t k = 0; k < dark.pixels(); ++k) {
    dark.values[k] = std::round(25.5F * image.values[k]) / 255.0F;
    before.values[k] = std::round(25.5F * image.values[k + 2 < dark.pixels() ? k + 2 : k]) / 255.0F;
  }
  enhance::EnhanceSettings settings;
  settings.denoiser = enhance::Denoiser::kNone;
  enhance::Enhancer enhancer(settings);
  const auto of_illumination = [&](const FloatImage& frame) {
    enhance::SmoothnessWeights weights;
    enhance::SmoothnessSystem system;
    weights.weigh(frame, settings.strategy, settings.alpha, settings.sigma_px, system);
    return system;
  };
  FloatImage exact;
  const double exact_ms =
      kEnhance_ms * processor_seconds_of([&] { exact = exact_illumination(of_illumination(dark), dark); });
  double cold_ms = 1e9, warm_ms = 1e9, cold_off = 0.0, warm_off = 0.0;
  for (int k = 0; k < kEnhanceRepeats; ++k) {
    const enhance::Enhanced* steps = nullptr;
    const auto illuminate = [&] { steps = &enhancer.illuminate(dark); };
    enhancer.forget();
    cold_ms = std::min(cold_ms, kEnhance_ms * processor_seconds_of(illuminate));
    cold_off = rms_of_range(steps->refined, exact);
    enhancer.forget();
    enhancer.illuminate(before);
    warm_ms = std::min(warm_ms, kEnhance_ms * processor_seconds_of(illuminate));
    warm_off = rms_of_range(steps->refined, exact);
  }
  rows.push_back({"illumination of " + name + ", cold (peer: exact solve)", cold_ms, exact_ms, "ms"});
  rows.push_back({"illumination of " + name + ", warm (peer: exact solve)", warm_ms, exact_ms, "ms"});
  rows.push_back({"illumination of " + name + ", cold: RMS off the exact one", 100.0 * cold_off, {}, "% of range"});
  rows.push_back({"illumination of " + name + ", warm: RMS off the exact one", 100.0 * warm_off, {}, "% of range"});
}

struct BestNlm {
  double psnr_db = 0.0, seconds = 0.0;
};

BestNlm best_nlm(const GreyBytes& noisy, const GreyBytes& clean) {
  BestNlm best;
  GreyBytes out;
  for (float strength = 10.0F; strength <= 22.0F; strength += 1.0F) {
    const double seconds = processor_seconds_of([&] { out = non_local_means(noisy, kWidth, kHeight, strength); });
    if (psnr_db(out, clean) > best.psnr_db) best = {psnr_db(out, clean), seconds};
  }
  return best;
}

void add_denoising(const std::string& name, const FloatImage& image, std::vector<BenchRow>& rows) {
  const std::vector<std::uint8_t> clean = bytes_of(image);
  FloatImage noisy = image, quiet;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, kSigma);
  for (std::size_t k = 0; k < clean.size(); ++k) {
    noisy.values[k] = static_cast<float>(std::clamp(std::round(clean[k] + noise(random)), 0.0, 255.0) / 255.0);
  }
  const std::vector<std::uint8_t> noisy_bytes = bytes_of(noisy);
  const double before = psnr_db(noisy_bytes, clean);
  const BestNlm nlm = best_nlm(noisy_bytes, clean);
  const auto add = [&](const char* what, auto&& denoise) {
    const double seconds = best_seconds(denoise);
    rows.push_back({name + ", " + what + ": gain (peer: NLM at its best)", psnr_db(bytes_of(quiet), clean) - before,
                    nlm.psnr_db - before, "dB", false});
    rows.push_back(
        {name + ", " + what + ": processor time (peer: NLM)", kEnhance_ms * seconds, kEnhance_ms * nlm.seconds, "ms"});
  };
  enhance::BlockDenoiser blocks;
  constexpr double kFraction = kSigma / 255.0;
  add("BM3D", [&] { blocks.bm3d(noisy, kFraction, {}, 1, quiet); });
  add("BM3D for video", [&] { blocks.bm3d(noisy, kFraction, enhance::kVideoBm3d, 1, quiet); });
  add("fast", [&] { blocks.thresholds(noisy, kFraction, 1, quiet); });
  const FloatImage& read_only = noisy;
  rows.push_back(
      {name + ": noise found (peer: given)", 255.0 * enhance::noise_level(read_only.view()), kSigma, "of 255", false});
}

}  // namespace

std::vector<BenchRow> bench_enhance(const EnhanceBench& options) {
  std::vector<BenchRow> rows;
  for (const char* name : {"aloeL.jpg", "building.jpg", "graf1.png"}) {
    const FloatImage image = middle_of_file(options.images + "/" + name);
    add_illumination(name, image, rows);
    add_denoising(name, image, rows);
  }
  add_dark_views(options.pairs, rows);
  return rows;
}

}  // namespace pharos::tools
