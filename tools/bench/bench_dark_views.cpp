// SPDX-License-Identifier: Apache-2.0
#include "tools/bench/bench_dark_views.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "host/vision/enhance/enhancer.hpp"
#include "tools/bench/stopwatch.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"

namespace pharos::tools {
namespace {

using enhance::Denoiser;
using enhance::Enhancer;
using Bytes = std::vector<std::uint8_t>;

constexpr int kApart = 10;  // frames of 0.5 deg
constexpr int kSide = 0;    // left
constexpr std::uint64_t kSeed = 1;

sim::TumblingScenario scenario(double ambient) {
  sim::TumblingScenario dark;
  dark.good_light = ambient <= 0.0;
  if (!dark.good_light) dark.ambient = ambient;
  dark.povray = false;  // no gloss: an ambient light makes none
  return dark;
}

Bytes bytes_of(const host::GreyImage& image) {
  Bytes bytes;
  for (const std::uint16_t value : image.pixels) bytes.push_back(static_cast<std::uint8_t>(value >> 8));
  return bytes;
}

Bytes enhanced(Enhancer& enhancer, const host::GreyImage& image) {
  const Bytes in = bytes_of(image);
  const enhance::Enhanced& steps =
      enhancer.enhance(ImageView<const std::uint8_t>(in.data(), image.width_px, image.height_px));
  Bytes out(in.size());
  enhance::to_integers(steps.result.view(), ImageView<std::uint8_t>(out.data(), image.width_px, image.height_px));
  return out;
}

// A halo: how far the mean of `image` where nothing of the target is within 2 px, but something within 10, is from its
// mean farther away.
double rim_light(const Bytes& image, const host::GreyImage& good) {
  const std::int32_t width = good.width_px, height = good.height_px;
  std::vector<std::uint8_t> near(image.size(), 0);  // 2: at the target, 1: around it
  constexpr std::int32_t kNear = 2, kFar = 10;
  constexpr std::uint16_t kTarget = 12 * 257;  // in good light the target is brighter than this
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < width; ++u) {
      if (good.view().at(u, v) < kTarget) continue;
      for (std::int32_t y = std::max(0, v - kFar); y <= std::min(height - 1, v + kFar); ++y) {
        for (std::int32_t x = std::max(0, u - kFar); x <= std::min(width - 1, u + kFar); ++x) {
          const bool touching = std::max(std::abs(x - u), std::abs(y - v)) <= kNear;
          std::uint8_t& place =
              near[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
          place = std::max<std::uint8_t>(place, touching ? 2 : 1);
        }
      }
    }
  }
  double rim = 0.0, away = 0.0;
  std::size_t rims = 0, aways = 0;
  for (std::size_t k = 0; k < image.size(); ++k) {
    if (near[k] == 1) rim += image[k], ++rims;
    if (near[k] == 0) away += image[k], ++aways;
  }
  return std::abs(rim / static_cast<double>(std::max<std::size_t>(1, rims)) -
                  away / static_cast<double>(std::max<std::size_t>(1, aways)));
}

void add_matches(double ambient, int pairs, const LowLightPeers& peers, std::vector<BenchRow>& rows) {
  sim::TumblingSequence dark(scenario(ambient), kSeed), good(scenario(0.0), kSeed);
  Enhancer enhancer;
  std::vector<double> plain, ours, clahe, retinex, rim_ours, rim_retinex;
  const int step = std::max(1, (dark.frames() - kApart - 1) / pairs);
  for (int k = 0; k < pairs; ++k) {
    const host::GreyImage a = dark.image(k * step, kSide), b = dark.image(k * step + kApart, kSide);
    const int width = a.width_px, height = a.height_px;
    const auto count = [&](const Bytes& x, const Bytes& y) {
      return static_cast<double>(peers.inliers(x.data(), y.data(), width, height));
    };
    const auto through = [&](auto filter, const host::GreyImage& image) {
      const Bytes in = bytes_of(image);
      Bytes out(in.size());
      filter(in.data(), width, height, out.data());
      return out;
    };
    plain.push_back(count(bytes_of(a), bytes_of(b)));
    clahe.push_back(count(through(peers.clahe, a), through(peers.clahe, b)));
    const Bytes retinex_a = through(peers.multi_scale_retinex, a);
    retinex.push_back(count(retinex_a, through(peers.multi_scale_retinex, b)));
    const Bytes ours_a = enhanced(enhancer, a);
    ours.push_back(count(ours_a, enhanced(enhancer, b)));
    const host::GreyImage lit = good.image(k * step, kSide);
    rim_ours.push_back(rim_light(ours_a, lit));
    rim_retinex.push_back(rim_light(retinex_a, lit));
  }
  const std::string what = "ambient " + std::to_string(ambient).substr(0, 4) + ": inliers ";
  rows.push_back({what + "(peer: as it is)", middle_of(ours), middle_of(plain), "", false});
  rows.push_back({what + "(peer: CLAHE)", middle_of(ours), middle_of(clahe), "", false});
  rows.push_back({what + "(peer: multi-scale retinex)", middle_of(ours), middle_of(retinex), "", false});
  rows.push_back({"ambient " + std::to_string(ambient).substr(0, 4) + ": light around the rim (peer: retinex)",
                  middle_of(rim_ours), middle_of(rim_retinex), "of 255"});
}

// A core a camera: pairs a second are one over the processor time of a warm frame.
void add_rate(const char* name, Denoiser denoiser, const enhance::Bm3dSettings& bm3d, std::vector<BenchRow>& rows) {
  sim::TumblingSequence dark(scenario(0.1), kSeed);
  enhance::EnhanceSettings settings;
  settings.denoiser = denoiser;
  settings.bm3d = bm3d;
  settings.threads = 1;
  Enhancer enhancer(settings);
  constexpr int kFrames = 10;
  std::vector<double> seconds;
  for (int k = 0; k <= kFrames; ++k) {
    const host::GreyImage image = dark.image(k, kSide);
    const double one = processor_seconds_of([&] { enhanced(enhancer, image); });
    if (k > 0) seconds.push_back(one);
  }
  rows.push_back({std::string("stereo pairs enhanced a second on two cores, ") + name,
                  1.0 / middle_of(seconds),
                  {},
                  "1/s",
                  false});
}

}  // namespace

void add_dark_views(int pairs, const LowLightPeers* peers, std::vector<BenchRow>& rows) {
  if (peers != nullptr) {
    for (const double ambient : {0.1, 0.01}) add_matches(ambient, pairs, *peers, rows);
  }
  add_rate("BM3D", Denoiser::kBm3d, {}, rows);
  add_rate("BM3D for video", Denoiser::kBm3d, enhance::kVideoBm3d, rows);
  add_rate("fast", Denoiser::kFast, {}, rows);
}

}  // namespace pharos::tools
