// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/povray/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pharos::sim {
namespace {

// Beyond so many sigmas a Gaussian holds 6e-5 of its weight.
constexpr double kReachSigmas = 4.0;
// Above so many electrons a Poisson number is a normal one to better than the read noise shows.
constexpr double kManyElectrons = 50.0;

// Weights of the pixels 0, 1, 2, ... from the middle: the Gaussian's integral over each pixel.
std::vector<float> kernel_of(double sigma_px) {
  const int reach = std::max(1, static_cast<int>(std::ceil(kReachSigmas * sigma_px)));
  const auto below = [sigma_px](double x) { return 0.5 * std::erf(x / (sigma_px * std::sqrt(2.0))); };
  std::vector<float> weights;
  for (int i = 0; i <= reach; ++i) weights.push_back(static_cast<float>(below(i + 0.5) - below(i - 0.5)));
  float total = weights[0];
  for (int i = 1; i <= reach; ++i) total += 2.0F * weights[static_cast<std::size_t>(i)];
  for (float& weight : weights) weight /= total;
  return weights;
}

// One line of `count` pixels, `step` apart, convolved; `line` is memory to work in.
void blur_line(float* first, std::int32_t count, std::ptrdiff_t step, const std::vector<float>& kernel,
               std::vector<float>& line) {
  const auto reach = static_cast<std::int32_t>(kernel.size()) - 1;
  line.resize(static_cast<std::size_t>(count + 2 * reach));
  for (std::int32_t i = 0; i < count + 2 * reach; ++i) {
    line[static_cast<std::size_t>(i)] = first[std::clamp(i - reach, 0, count - 1) * step];
  }
  for (std::int32_t i = 0; i < count; ++i) {
    const float* middle = line.data() + i + reach;
    float sum = kernel[0] * middle[0];
    for (std::int32_t k = 1; k <= reach; ++k) sum += kernel[static_cast<std::size_t>(k)] * (middle[k] + middle[-k]);
    first[i * step] = sum;
  }
}

double electrons_of(double mean_e, RandomStream& random) {
  if (mean_e < kManyElectrons) return random.poisson(mean_e);
  return mean_e + std::sqrt(mean_e) * random.normal();
}

}  // namespace

LinearImage blurred(const LinearImage& image, double sigma_px) {
  LinearImage out = image;
  if (sigma_px <= 0.0 || image.light.empty()) return out;
  const std::vector<float> kernel = kernel_of(sigma_px);
  std::vector<float> line;
  for (std::int32_t v = 0; v < out.height_px; ++v) blur_line(&out.at(0, v), out.width_px, 1, kernel, line);
  for (std::int32_t u = 0; u < out.width_px; ++u) blur_line(&out.at(u, 0), out.height_px, out.width_px, kernel, line);
  return out;
}

double peak_light(const LinearImage& image) {
  if (image.light.empty()) return 0.0;
  std::vector<float> sorted = image.light;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 999 / 1000);
  std::nth_element(sorted.begin(), place, sorted.end());
  return static_cast<double>(*place);
}

host::GreyImage expose(const LinearImage& image, const ImageSensor& sensor, RandomStream& random) {
  const double largest = sensor.bits == 8 ? 255.0 : 65535.0;
  const double step = 65535.0 / largest;
  host::GreyImage grey{image.width_px, image.height_px, sensor.bits, std::vector<std::uint16_t>(image.light.size())};
  for (std::size_t i = 0; i < image.light.size(); ++i) {
    const double light_e = electrons_of(static_cast<double>(image.light[i]) * sensor.electrons_per_light, random);
    const double read_e = std::min(light_e, sensor.full_well_e) + sensor.read_noise_e * random.normal();
    const double count = std::clamp(std::round(read_e / sensor.full_well_e * largest), 0.0, largest);
    grey.pixels[i] = static_cast<std::uint16_t>(count * step);
  }
  return grey;
}

}  // namespace pharos::sim
