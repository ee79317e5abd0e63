// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/pointing/pointing_image.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "pharos/base/units.hpp"
#include "tools/sim/optics/blur.hpp"
#include "tools/sim/povray/render_scene.hpp"

namespace pharos::sim {
namespace {

// A point of light among four pixels, where nothing stands before it.
void add_star(LinearImage& image, double u, double v, double light) {
  const auto u0 = static_cast<std::int32_t>(u), v0 = static_cast<std::int32_t>(v);
  const double du = u - u0, dv = v - v0;
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
    if (image.at(u0 + x, v0 + y) > 0.0F) return;
  }
  const auto add = [&](int x, int y, double fraction) {
    image.at(u0 + x, v0 + y) += static_cast<float>(fraction * light);
  };
  add(0, 0, (1.0 - du) * (1.0 - dv));
  add(1, 0, du * (1.0 - dv));
  add(0, 1, (1.0 - du) * dv);
  add(1, 1, du * dv);
}

// Brightnesses as star counts go: four times as many at half the light.
void add_stars(LinearImage& image, const PointingImaging& imaging, RandomStream& random) {
  const double spread = std::max(0.3, imaging.seeing_px);
  const double whole = imaging.star_light * kTwoPi * spread * spread;
  for (int k = 0; k < imaging.stars; ++k) {
    const double fraction = k == 0 ? 1.0 : std::min(1.0, 1.0 / std::sqrt(1.0 + imaging.stars * random.uniform()));
    add_star(image, random.uniform(0.0, image.width_px - 2.0), random.uniform(0.0, image.height_px - 2.0),
             whole * fraction);
  }
}

}  // namespace

host::GreyImage pointing_image(const PointingScenario& scenario, std::size_t index, std::uint64_t seed) {
  const PointingImaging& imaging = scenario.imaging;
  RandomStream random(seed, "line image " + std::to_string(index));
  const Vector2 middle(0.5 * (scenario.camera.width_px - 1) + imaging.tracking_px * random.normal(),
                       0.5 * (scenario.camera.height_px - 1) + imaging.tracking_px * random.normal());
  RenderSettings settings;
  settings.width_px = scenario.camera.width_px;
  settings.height_px = scenario.camera.height_px;
  settings.rays_per_side = imaging.rays_per_side;
  settings.antialias_threshold = imaging.antialias_threshold;
  LinearImage light = render_scene(pointing_scene(scenario, scenario.views[index], middle), settings);
  ImageSensor sensor = imaging.sensor;
  // The satellite's own light, however small it stands in the image; 1 where it is not in it.
  const double peak = peak_light(light, true);
  sensor.electrons_per_light = imaging.peak * sensor.full_well_e / (peak > 0.0 ? std::max(1e-3, peak) : 1.0);
  add_stars(light, imaging, random);
  for (float& pixel : light.light) pixel += static_cast<float>(imaging.sky_light);
  return expose(blurred(light, imaging.seeing_px), sensor, random);
}

}  // namespace pharos::sim
