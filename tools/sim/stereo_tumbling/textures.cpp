// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/stereo_tumbling/textures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pharos::sim {
namespace {

// Of the texture: what a pixel sees of the satellite from 5 m with 640 px of focal length is 8 mm.
constexpr double kTexel_m = 0.004;
// Of a wall: a pixel of the room's cameras sees 8 mm from 4 m.
constexpr double kWallTexel_m = 0.008;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();

Texture blank(double width_m, double height_m, double texel_m, float albedo) {
  const auto cells = [texel_m](double side_m) { return std::max(8, static_cast<int>(std::lround(side_m / texel_m))); };
  Texture texture{cells(width_m), cells(height_m), {}};
  texture.albedo.assign(static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height), albedo);
  return texture;
}

struct Seed {
  double x, y;
  float shade;
};

// Facets: the nearest and second nearest seed of a jittered grid tell shade and crease.
class Facets {
 public:
  Facets(double width, double height, double side, RandomStream& random)
      : side_(side), columns_(static_cast<int>(width / side) + 3), rows_(static_cast<int>(height / side) + 3) {
    for (int k = 0; k < columns_ * rows_; ++k) {
      seeds_.push_back({(k % columns_ - 1 + random.uniform()) * side_, (k / columns_ - 1 + random.uniform()) * side_,
                        static_cast<float>(random.uniform(0.15, 0.95))});
    }
  }

  float shade(double x, double y) const {
    const int column = static_cast<int>(x / side_) + 1, row = static_cast<int>(y / side_) + 1;
    double nearest = 1e9, second = 1e9;
    double limit = kNoLimit;  // square of a distance that is certainly neither
    float shade = 0.0F;
    for (int r = std::max(0, row - 2); r <= std::min(rows_ - 1, row + 2); ++r) {
      for (int c = std::max(0, column - 2); c <= std::min(columns_ - 1, column + 2); ++c) {
        const Seed& seed = seeds_[static_cast<std::size_t>(r * columns_ + c)];
        const double dx = x - seed.x, dy = y - seed.y;
        if (dx * dx + dy * dy > limit) continue;
        const double distance = std::hypot(dx, dy);  // slow, and exact: few are taken
        if (distance < nearest) {
          second = nearest;
          nearest = distance;
          shade = seed.shade;
        } else {
          second = std::min(second, distance);
        }
        limit = second * second * (1.0 + 1e-9);
      }
    }
    const bool crease = second - nearest < 0.06 * side_;
    return crease ? 0.5F * shade : shade;
  }

 private:
  double side_;
  int columns_, rows_;
  std::vector<Seed> seeds_;
};

void fill_rectangle(Texture& texture, double s0, double t0, double s1, double t1, float albedo) {
  const auto clip = [](double value, std::int32_t maximum) {
    return std::clamp(static_cast<std::int32_t>(std::lround(value)), 0, maximum);
  };
  for (std::int32_t t = clip(t0, texture.height); t < clip(t1, texture.height); ++t) {
    const auto row = texture.albedo.begin() + static_cast<std::ptrdiff_t>(t) * texture.width;
    std::fill(row + clip(s0, texture.width), row + std::max(clip(s0, texture.width), clip(s1, texture.width)), albedo);
  }
}

}  // namespace

Texture foil_texture(double width_m, double height_m, double facet_m, RandomStream& random) {
  Texture texture = blank(width_m, height_m, kTexel_m, 0.0F);
  const double side = facet_m / kTexel_m;
  const Facets fine(texture.width, texture.height, side, random);
  const Facets broad(texture.width, texture.height, 4.0 * side, random);
  for (std::int32_t t = 0; t < texture.height; ++t) {
    for (std::int32_t s = 0; s < texture.width; ++s) {
      texture
          .albedo[static_cast<std::size_t>(t) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(s)] =
          0.6F * fine.shade(s, t) + 0.4F * broad.shade(s, t);
    }
  }
  return texture;
}

Texture solar_texture(double width_m, double height_m, double cell_m, RandomStream& random) {
  Texture texture = blank(width_m, height_m, kTexel_m, 0.75F);
  const double side = cell_m / kTexel_m;
  const double gap = std::max(1.0, 0.06 * side);
  for (double t = gap; t < texture.height; t += side) {
    for (double s = gap; s < texture.width; s += side) {
      const auto shade = static_cast<float>(random.uniform(0.10, 0.35));
      fill_rectangle(texture, s, t, s + side - gap, t + side - gap, shade);
      for (int mark = 0; mark < 2; ++mark) {
        const double x = s + random.uniform(0.1, 0.7) * side, y = t + random.uniform(0.1, 0.7) * side;
        const auto bright = static_cast<float>(random.uniform(0.3, 0.9));
        fill_rectangle(texture, x, y, x + random.uniform(0.1, 0.3) * side, y + random.uniform(0.1, 0.3) * side, bright);
      }
    }
  }
  return texture;
}

Texture wall_texture(double width_m, double height_m, RandomStream& random) {
  Texture texture = blank(width_m, height_m, kWallTexel_m, 0.0F);
  const Facets stains(texture.width, texture.height, 0.7 / kWallTexel_m, random);
  for (std::int32_t t = 0; t < texture.height; ++t) {
    for (std::int32_t s = 0; s < texture.width; ++s) {
      texture
          .albedo[static_cast<std::size_t>(t) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(s)] =
          0.45F + 0.25F * stains.shade(s, t);
    }
  }
  const int pictures = static_cast<int>(width_m * height_m * 14.0);
  for (int k = 0; k < pictures; ++k) {
    const double x = random.uniform(0.0, texture.width), y = random.uniform(0.0, texture.height);
    const double wide = random.uniform(0.03, 0.4) / kWallTexel_m, high = random.uniform(0.03, 0.3) / kWallTexel_m;
    fill_rectangle(texture, x, y, x + wide, y + high, static_cast<float>(random.uniform(0.05, 0.95)));
  }
  return texture;
}

}  // namespace pharos::sim
