// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluation/bench/bench_dark_views.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "host/vision/enhance/enhancer.hpp"
#include "host/vision/slam/slam_system.hpp"
#include "tools/evaluation/low_light/low_light_peers.hpp"
#include "tools/evaluation/low_light/rim_halo.hpp"
#include "tools/sim/stereo_tumbling/tumbling_sequence.hpp"
#include "tools/support/stopwatch.hpp"

namespace pharos::tools {
namespace {

using enhance::Denoiser;
using enhance::Enhancer;
using Bytes = GreyBytes;

constexpr int kApart = 10;  // frames of 0.5 deg
constexpr int kSide = 0;    // left
constexpr double kMs = 1e3;
constexpr std::uint64_t kSeed = 1;

constexpr double kEven = 0.8;  // ambient light in which the target is as bright as in good light

sim::TumblingScenario scenario(double ambient) {
  sim::TumblingScenario dark;
  dark.good_light = false;
  dark.ambient = ambient;
  if (ambient == kEven) dark.stars = 0;
  dark.povray = false;  // no gloss: ambient light has no highlights
  return dark;
}

// Maximum error at the rim over pairs, of 255.
struct Halos {
  double outside = 0.0, inside = 0.0;
  void add(const Bytes& image, const host::GreyImage& even) {
    const RimHalo halo =
        rim_halo(ImageView<const std::uint8_t>(image.data(), even.width_px, even.height_px), even.view());
    outside = std::max(outside, 255.0 * std::abs(halo.outside));
    inside = std::max(inside, 255.0 * std::abs(halo.inside));
  }
};

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

void add_matches(double ambient, int pairs, std::vector<BenchRow>& rows) {
  sim::TumblingSequence dark(scenario(ambient), kSeed), even(scenario(kEven), kSeed);
  Enhancer enhancer;
  std::vector<double> plain, ours, equalised, retinex;
  Halos rim_ours, rim_retinex;
  const int step = std::max(1, (dark.frames() - kApart - 1) / pairs);
  for (int k = 0; k < pairs; ++k) {
    const host::GreyImage a = dark.image(k * step, kSide), b = dark.image(k * step + kApart, kSide);
    const int width = a.width_px, height = a.height_px;
    const auto count = [&](const Bytes& x, const Bytes& y) {
      return static_cast<double>(inliers_of_orb(x, y, width, height));
    };
    const auto through = [&](auto filter, const host::GreyImage& image) {
      return filter(bytes_of(image), width, height);
    };
    plain.push_back(count(bytes_of(a), bytes_of(b)));
    equalised.push_back(count(through(clahe, a), through(clahe, b)));
    const Bytes retinex_a = through(multi_scale_retinex, a);
    retinex.push_back(count(retinex_a, through(multi_scale_retinex, b)));
    const Bytes ours_a = enhanced(enhancer, a);
    ours.push_back(count(ours_a, enhanced(enhancer, b)));
    const host::GreyImage in_even_light = even.image(k * step, kSide);
    rim_ours.add(ours_a, in_even_light);
    rim_retinex.add(retinex_a, in_even_light);
  }
  const std::string what = "ambient " + std::to_string(ambient).substr(0, 4) + ": inliers ";
  rows.push_back({what + "(peer: as it is)", middle_of(ours), middle_of(plain), "", false});
  rows.push_back({what + "(peer: CLAHE)", middle_of(ours), middle_of(equalised), "", false});
  rows.push_back({what + "(peer: multi-scale retinex)", middle_of(ours), middle_of(retinex), "", false});
  const std::string rim = "ambient " + std::to_string(ambient).substr(0, 4) + ": off ";
  rows.push_back({rim + "outside the rim, at most (peer: retinex)", rim_ours.outside, rim_retinex.outside, "of 255"});
  rows.push_back({rim + "inside the rim, at most (peer: retinex)", rim_ours.inside, rim_retinex.inside, "of 255"});
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

// A core a camera, then this thread tracks while another one maps: one over the processor time of both.
void add_rate_to_pose(std::vector<BenchRow>& rows) {
  sim::TumblingSequence dark(scenario(0.1), kSeed);
  enhance::EnhanceSettings settings;
  settings.denoiser = Denoiser::kFast;
  settings.threads = 1;
  std::array<Enhancer, 2> enhancers = {Enhancer(settings), Enhancer(settings)};
  slam::SlamSettings tracking;
  tracking.threads = true;
  const auto system = slam::make_slam(dark.rig(), "the simulated rig", tracking);
  constexpr int kPairs = 30, kBegin = 5;
  std::vector<double> eye_s, track_s, whole_s;
  for (int k = 0; k < kPairs; ++k) {
    std::array<Bytes, 2> bytes;
    const host::GreyImage first = dark.image(k, 0), second = dark.image(k, 1);
    const double left_s = processor_seconds_of([&] { bytes[0] = enhanced(enhancers[0], first); });
    const double right_s = processor_seconds_of([&] { bytes[1] = enhanced(enhancers[1], second); });
    const auto view = [&first](const Bytes& of) {
      return ImageView<const std::uint8_t>(of.data(), first.width_px, first.height_px);
    };
    const double push_s = processor_seconds_of([&] { system->push(0.05 * k, view(bytes[0]), view(bytes[1])); });
    if (k < kBegin) continue;
    eye_s.push_back(std::max(left_s, right_s));
    track_s.push_back(push_s);
    whole_s.push_back(eye_s.back() + push_s);
  }
  const auto add = [&rows](const char* what, const std::vector<double>& seconds) {
    rows.push_back({what, kMs * middle_of(seconds), {}, "ms"});
  };
  add("a dark pair, slower camera: processor time of the enhancement, fast", eye_s);
  add("the same pair: processor time of tracking", track_s);
  rows.push_back(
      {"enhanced pairs to their poses a second on two cores, fast", 1.0 / middle_of(whole_s), {}, "1/s", false});
}

}  // namespace

void add_dark_views(int pairs, std::vector<BenchRow>& rows) {
  for (const double ambient : {0.1, 0.01}) add_matches(ambient, pairs, rows);
  add_rate("BM3D", Denoiser::kBm3d, {}, rows);
  add_rate("BM3D for video", Denoiser::kBm3d, enhance::kVideoBm3d, rows);
  add_rate("fast", Denoiser::kFast, {}, rows);
  add_rate_to_pose(rows);
}

}  // namespace pharos::tools
