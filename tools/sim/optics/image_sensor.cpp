// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/optics/image_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pharos::sim {
namespace {

// Above so many electrons a Poisson number is a normal one to better than the read noise shows.
constexpr double kManyElectrons = 20.0;
// A pixel whose mean is so many deviations below the full well never fills it.
constexpr double kFarFromFull = 6.0;

// Electrons read of a pixel: shot noise, full well, read noise.
double read_electrons(double mean_e, const ImageSensor& sensor, RandomStream& random) {
  if (!sensor.shot_noise) return std::min(mean_e, sensor.full_well_e) + sensor.read_noise_e * random.normal();
  const double read_variance = sensor.read_noise_e * sensor.read_noise_e;
  if (mean_e < kManyElectrons) return random.poisson(mean_e) + sensor.read_noise_e * random.normal();
  if (mean_e + kFarFromFull * std::sqrt(mean_e) < sensor.full_well_e) {
    return mean_e + std::sqrt(mean_e + read_variance) * random.normal();
  }
  const double light_e = mean_e + std::sqrt(mean_e) * random.normal();
  return std::min(light_e, sensor.full_well_e) + sensor.read_noise_e * random.normal();
}

}  // namespace

double peak_light(const LinearImage& image, bool lit_only) {
  std::vector<float> sorted = image.light;
  if (lit_only) std::erase_if(sorted, [](float light) { return !(light > 0.0F); });
  if (sorted.empty()) return 0.0;
  const auto place = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 999 / 1000);
  std::nth_element(sorted.begin(), place, sorted.end());
  return static_cast<double>(*place);
}

host::GreyImage expose(const LinearImage& image, const ImageSensor& sensor, RandomStream& random) {
  const double largest = sensor.bits == 8 ? 255.0 : 65535.0;
  const double step = 65535.0 / largest;
  host::GreyImage grey{image.width_px, image.height_px, sensor.bits, std::vector<std::uint16_t>(image.light.size())};
  for (std::size_t i = 0; i < image.light.size(); ++i) {
    const double mean_e = static_cast<double>(image.light[i]) * sensor.electrons_per_light;
    const double read_e = read_electrons(mean_e, sensor, random);
    const double count = std::clamp(std::round(read_e / sensor.full_well_e * largest), 0.0, largest);
    grey.pixels[i] = static_cast<std::uint16_t>(count * step);
  }
  return grey;
}

}  // namespace pharos::sim
