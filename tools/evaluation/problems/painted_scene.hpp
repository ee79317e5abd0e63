// SPDX-License-Identifier: Apache-2.0
#pragma once

// Flat shapes in front of a pinhole camera, painted one over the other with exact edges: images with known ellipses.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

namespace pharos::test {

/// Semi-axes a >= b, theta from +u towards +v in (-pi/2, pi/2]; pixel (0, 0) is the first pixel's centre.
struct TrueEllipse {
  double cx_px = 0.0, cy_px = 0.0, a_px = 0.0, b_px = 0.0, theta_rad = 0.0;
};

/// No distortion; the principal point at the centre of the image.
struct PaintedCamera {
  int width_px = 640, height_px = 480;
  double focal_px = 608.0;  // paper 000, table 1

  double cx_px() const { return 0.5 * (width_px - 1); }
  double cy_px() const { return 0.5 * (height_px - 1); }
};

using Vec3 = std::array<double, 3>;

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A disc in space, in the camera's frame (x right, y down, z forward).
struct Disc {
  Vec3 centre_m;
  Vec3 normal;  // unit
  double radius_m;

  bool covers(const PaintedCamera& camera, double u, double v) const {
    const Vec3 ray = {(u - camera.cx_px()) / camera.focal_px, (v - camera.cy_px()) / camera.focal_px, 1.0};
    const double away = dot(normal, centre_m) / dot(normal, ray);
    const Vec3 off = {ray[0] * away - centre_m[0], ray[1] * away - centre_m[1], ray[2] * away - centre_m[2]};
    return away > 0.0 && dot(off, off) < radius_m * radius_m;
  }

  /// Its outline in the image. On the ray d: |d s - c|^2 = r^2 with s = n.c / n.d, a quadratic form in d.
  TrueEllipse outline(const PaintedCamera& camera) const {
    const double k = dot(normal, centre_m);
    std::array<Vec3, 3> q{};  // d^T q d = 0
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        q[i][j] = (i == j ? k * k : 0.0) - k * (centre_m[i] * normal[j] + centre_m[j] * normal[i]) +
                  (dot(centre_m, centre_m) - radius_m * radius_m) * normal[i] * normal[j];
      }
    }
    const double det = q[0][0] * q[1][1] - q[0][1] * q[0][1];
    const double x = (q[0][1] * q[1][2] - q[1][1] * q[0][2]) / det, y = (q[0][1] * q[0][2] - q[0][0] * q[1][2]) / det;
    const double rest = -(q[0][2] * x + q[1][2] * y + q[2][2]);
    const double mean = 0.5 * (q[0][0] + q[1][1]), spread = std::hypot(0.5 * (q[0][0] - q[1][1]), q[0][1]);
    double theta = 0.5 * std::atan2(2.0 * q[0][1], q[0][0] - q[1][1]) + 0.5 * std::numbers::pi;
    theta = std::remainder(theta, std::numbers::pi);
    if (theta <= -0.5 * std::numbers::pi) theta += std::numbers::pi;
    const double low = rest > 0.0 ? mean - spread : mean + spread, high = rest > 0.0 ? mean + spread : mean - spread;
    return {camera.cx_px() + camera.focal_px * x, camera.cy_px() + camera.focal_px * y,
            camera.focal_px * std::sqrt(rest / low), camera.focal_px * std::sqrt(rest / high), theta};
  }
};

/// A convex polygon in the image, its corners in the order of rising angle from +u towards +v.
struct Polygon {
  std::vector<std::array<double, 2>> corners_px;

  bool covers(const PaintedCamera&, double u, double v) const {
    for (std::size_t k = 0; k < corners_px.size(); ++k) {
      const auto &a = corners_px[k], &b = corners_px[(k + 1) % corners_px.size()];
      if ((b[0] - a[0]) * (v - a[1]) - (b[1] - a[1]) * (u - a[0]) < 0.0) return false;
    }
    return true;
  }
};

struct Layer {
  std::variant<Disc, Polygon> shape;
  double value;  // 0 dark to 1 full scale

  bool covers(const PaintedCamera& camera, double u, double v) const {
    return std::visit([&](const auto& s) { return s.covers(camera, u, v); }, shape);
  }
};

/// Effects of lens and sensor.
struct Imaging {
  double blur_px = 0.7;         // sigma of the lens
  double full_well_e = 8000.0;  // shot noise
  double read_noise_e = 20.0;
  double full_scale = 60000.0;  // counts of value 1
};

/// Blurred by a Gaussian; the border's values continue outside.
inline std::vector<double> blurred(const std::vector<double>& light, int w, int h, double sigma) {
  const int reach = static_cast<int>(std::ceil(4.0 * sigma));
  std::vector<double> kernel;
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) sum += kernel.emplace_back(std::exp(-0.5 * k * k / (sigma * sigma)));
  std::vector<double> rows;
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<double>& in = pass == 0 ? light : rows;
    std::vector<double> out(light.size(), 0.0);
    for (int v = 0; v < h; ++v) {
      for (int u = 0; u < w; ++u) {
        double mean = 0.0;
        for (int k = -reach; k <= reach; ++k) {
          const int x = pass == 0 ? std::clamp(u + k, 0, w - 1) : u, y = pass == 0 ? v : std::clamp(v + k, 0, h - 1);
          mean += kernel[static_cast<std::size_t>(k + reach)] * in[static_cast<std::size_t>(y * w + x)];
        }
        out[static_cast<std::size_t>(v * w + u)] = mean / sum;
      }
    }
    rows = std::move(out);
  }
  return rows;
}

/// Light of 0 to 1 through lens and sensor: grey values 0 to 65535, row by row.
inline std::vector<std::uint16_t> photographed(const std::vector<double>& light, int w, int h, const Imaging& imaging,
                                               std::mt19937_64& random) {
  const std::vector<double> seen_light = blurred(light, w, h, imaging.blur_px);
  std::vector<std::uint16_t> pixels(light.size());
  std::normal_distribution<double> normal;
  for (std::size_t k = 0; k < light.size(); ++k) {
    const double electrons = imaging.full_well_e * seen_light[k];
    const double seen = electrons + std::sqrt(electrons + imaging.read_noise_e * imaging.read_noise_e) * normal(random);
    pixels[k] =
        static_cast<std::uint16_t>(std::clamp(seen / imaging.full_well_e * imaging.full_scale + 0.5, 0.0, 65535.0));
  }
  return pixels;
}

class PaintedScene {
 public:
  explicit PaintedScene(PaintedCamera camera, double background) : camera_(camera), background_(background) {}
  void add(Layer layer) {
    boxes_.push_back(box_of(layer));
    layers_.push_back(std::move(layer));
  }
  const PaintedCamera& camera() const { return camera_; }

  /// Grey values 0 to 65535, row by row.
  std::vector<std::uint16_t> image(const Imaging& imaging, std::mt19937_64& random) const {
    return photographed(painted(), camera_.width_px, camera_.height_px, imaging, random);
  }
  /// Uppermost layer at a position; -1 is the background.
  int layer_at(double u, double v) const {
    for (std::size_t k = layers_.size(); k-- > 0;) {
      if (boxes_[k].contains(u, v) && layers_[k].covers(camera_, u, v)) return static_cast<int>(k);
    }
    return -1;
  }

 private:
  static constexpr double kEverywhere = std::numeric_limits<double>::infinity();
  // Around a polygon, whose sides take longer to look at; a disc's is everything.
  struct Box {
    std::array<double, 2> low{-kEverywhere, -kEverywhere}, high{kEverywhere, kEverywhere};
    bool contains(double u, double v) const { return u >= low[0] && u <= high[0] && v >= low[1] && v <= high[1]; }
  };
  static Box box_of(const Layer& layer) {
    const auto* polygon = std::get_if<Polygon>(&layer.shape);
    if (polygon == nullptr || polygon->corners_px.empty()) return {};
    Box box{polygon->corners_px.front(), polygon->corners_px.front()};
    for (const auto& corner : polygon->corners_px) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        box.low[axis] = std::min(box.low[axis], corner[axis]);
        box.high[axis] = std::max(box.high[axis], corner[axis]);
      }
    }
    return box;
  }

  double value_of(int layer) const { return layer < 0 ? background_ : layers_[static_cast<std::size_t>(layer)].value; }

  // Mean intensity of each pixel: 8 x 8 samples where its corners differ, one sample elsewhere.
  std::vector<double> painted() const {
    const int w = camera_.width_px, h = camera_.height_px, stride = w + 1;
    std::vector<int> corner(static_cast<std::size_t>(stride * (h + 1)));
    for (int v = 0; v <= h; ++v) {
      for (int u = 0; u <= w; ++u) corner[static_cast<std::size_t>(v * stride + u)] = layer_at(u - 0.5, v - 0.5);
    }
    std::vector<double> light(static_cast<std::size_t>(w * h));
    for (int v = 0; v < h; ++v) {
      for (int u = 0; u < w; ++u) {
        const auto at = [&](int du, int dv) { return corner[static_cast<std::size_t>((v + dv) * stride + u + du)]; };
        const bool plain = at(0, 0) == at(1, 0) && at(0, 0) == at(0, 1) && at(0, 0) == at(1, 1);
        light[static_cast<std::size_t>(v * w + u)] = plain ? value_of(at(0, 0)) : mean_of_pixel(u, v);
      }
    }
    return light;
  }
  double mean_of_pixel(int u, int v) const {
    constexpr int kPlaces = 8;
    double sum = 0.0;
    for (int j = 0; j < kPlaces; ++j) {
      for (int i = 0; i < kPlaces; ++i) {
        sum += value_of(layer_at(u - 0.5 + (i + 0.5) / kPlaces, v - 0.5 + (j + 0.5) / kPlaces));
      }
    }
    return sum / (kPlaces * kPlaces);
  }

  PaintedCamera camera_;
  double background_;
  std::vector<Layer> layers_;
  std::vector<Box> boxes_;
};

}  // namespace pharos::test
