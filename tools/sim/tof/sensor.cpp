// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/tof/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/sim/optics/blur.hpp"

namespace pharos::sim {
namespace {

constexpr std::size_t kQuantiles = std::size_t{1} << 16;
constexpr double kLastCount = 65534.0;  // 65535 means invalid, too

// The middle quantile of each of 2^16 equal shares, by Newton's method from the neighbour.
std::vector<float> normal_quantiles() {
  std::vector<float> quantiles(kQuantiles);
  double z = 0.0;
  for (std::size_t i = kQuantiles / 2; i < kQuantiles; ++i) {
    const double fraction = (static_cast<double>(i) + 0.5) / kQuantiles;
    for (int step = 0; step < 8; ++step) {
      const double upper = 0.5 * std::erfc(z / std::numbers::sqrt2);
      const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
      z += (upper - (1.0 - fraction)) / density;
    }
    quantiles[i] = static_cast<float>(z);
    quantiles[kQuantiles - 1 - i] = static_cast<float>(-z);
  }
  return quantiles;
}

// Unit variance, correlation exp(-distance^2 / correlation^2): white noise blurred by half the distance.
std::vector<float> correlated_noise(const Lens& lens, double correlation_px, RandomStream& random) {
  std::vector<float> noise(static_cast<std::size_t>(lens.width_px) * static_cast<std::size_t>(lens.height_px));
  fill_normal(noise, random);
  if (correlation_px <= 0.0) return noise;
  const Kernel kernel = gaussian_at_pixels(0.5 * correlation_px);
  convolve(noise, lens.width_px, lens.height_px, kernel);
  const auto gain = static_cast<float>(1.0 / std::sqrt(variance_ratio(kernel)));
  for (float& value : noise) value *= gain;
  return noise;
}

}  // namespace

void fill_normal(std::vector<float>& values, RandomStream& random) {
  static const std::vector<float> kTable = normal_quantiles();
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 4 == 0) bits = random.bits();
    values[i] = kTable[bits & (kQuantiles - 1)];
    bits >>= 16;
  }
}

TofPixels expose(const IdealFrame& ideal, const PixelRays& rays, const SensorModel& sensor, double nominal_counts,
                 const DepthScale& scale, RandomStream random) {
  TofPixels pixels{rays.lens().width_px, rays.lens().height_px, {}, {}};
  const std::size_t count = ideal.amplitude_counts.size();
  pixels.intensity.resize(count);
  pixels.depth.resize(count);
  const double common_m = sensor.common_sigma_m * random.normal();
  const std::vector<float> depth_noise = correlated_noise(rays.lens(), sensor.correlation_px, random);
  std::vector<float> light_noise(count);
  fill_normal(light_noise, random);
  for (int v = 0; v < pixels.height_px; ++v) {
    for (int u = 0; u < pixels.width_px; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(pixels.width_px) + static_cast<std::size_t>(u);
      const auto ideal_counts = static_cast<double>(ideal.amplitude_counts[i]);
      const double variance =
          ideal_counts / sensor.electrons_per_count + sensor.read_noise_counts * sensor.read_noise_counts;
      // An amplitude is a length: what noise takes below zero comes out above.
      const double counts = std::abs(ideal_counts + std::sqrt(variance) * static_cast<double>(light_noise[i]));
      const bool saturated = counts >= sensor.full_counts;
      pixels.intensity[i] = saturated ? std::uint16_t{65535} : static_cast<std::uint16_t>(counts + 0.5);
      double depth_counts = 0.0;  // invalid
      const bool mixed = !ideal.spread_m.empty() && static_cast<double>(ideal.spread_m[i]) > sensor.max_spread_m;
      if (!saturated && !mixed && counts >= sensor.min_counts) {
        const double dimmer = nominal_counts / std::max(ideal_counts, sensor.min_counts);
        const double sigma_m =
            sensor.sigma_nominal_m * (sensor.noise_exponent == 1.0 ? dimmer : std::pow(dimmer, sensor.noise_exponent));
        double range = static_cast<double>(ideal.range_m[i]) + common_m + sigma_m * static_cast<double>(depth_noise[i]);
        if (sensor.stray_rate > 0.0 && random.uniform() < sensor.stray_rate) range += random.uniform(-1.0, 1.0);
        if (range >= sensor.range_limit_m) range = std::fmod(range, sensor.range_limit_m);
        const double z = range / rays.range_per_depth(u, v) - scale.origin_z_m;
        depth_counts = z / scale.scale_m + 0.5;  // cut off below: rounded
      }
      const bool fits = depth_counts >= 1.0 && depth_counts < kLastCount + 1.0;
      pixels.depth[i] = static_cast<std::uint16_t>(fits ? depth_counts : 0.0);
    }
  }
  return pixels;
}

}  // namespace pharos::sim
