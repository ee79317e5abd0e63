// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/satellite_scene.hpp"

#include <array>
#include <cmath>

#include "tools/sim/stereo_tumbling/textures.hpp"

namespace pharos::sim {
namespace {

constexpr double kFacet_m = 0.045;  // of the foil: 6 px from 5 m
constexpr double kCell_m = 0.12;    // of the solar panels
constexpr double kThickness_m = 0.03;
constexpr std::size_t kFoils = 6;  // the first textures
// Albedo in red, green and blue, the brightest 1.
constexpr std::array<float, 3> kGold = {1.0F, 0.78F, 0.36F}, kCells = {0.35F, 0.5F, 1.0F};

}  // namespace

PanelScene satellite_scene(std::uint64_t seed) {
  PanelScene scene;
  RandomStream random(seed, "satellite");
  const Vector3 half(0.7, 0.7, 0.8);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    scene.textures.push_back(foil_texture(2.0 * half[(axis + 1) % 3], 2.0 * half[(axis + 2) % 3], kFacet_m, random));
  }
  add_box(scene, Vector3::Zero(), half, 0);
  for (const double side : {-1.0, 1.0}) {
    for (const double face : {-0.5, 0.5}) {
      scene.textures.push_back(solar_texture(1.1, 1.0, kCell_m, random));
      const double inner = side * 0.8;
      scene.panels.push_back({Vector3(inner, face * kThickness_m, -0.5), Vector3(side * 1.1, 0.0, 0.0),
                              Vector3(0.0, 0.0, 1.0), static_cast<int>(scene.textures.size()) - 1});
    }
  }
  return scene;
}

PanelScene through_filter(PanelScene satellite, int channel) {
  for (std::size_t k = 0; k < satellite.textures.size(); ++k) {
    const float tint = (k < kFoils ? kGold : kCells)[static_cast<std::size_t>(channel)];
    for (float& albedo : satellite.textures[k].albedo) albedo *= tint;
  }
  return satellite;
}

std::vector<Star> star_field(int count, std::uint64_t seed) {
  std::vector<Star> stars;
  RandomStream random(seed, "stars");
  for (int k = 0; k < count; ++k) {
    const Vector3 direction = Vector3(random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5), 1.0).normalized();
    stars.push_back({direction, 0.04 * std::pow(random.uniform(0.03, 1.0), -0.8)});
  }
  return stars;
}

}  // namespace pharos::sim
