// SPDX-License-Identifier: Apache-2.0
#pragma once

// Ellipses and polygons drawn straight into the image, and sheets of dots and rings as they calibrate cameras: many
// small ellipses of known place. Independent of the detector.
#include "tools/evaluation/problems/ring_images.hpp"

namespace pharos::test {

/// Light of every pixel; shapes are filled in turn, each by the part of a pixel that it covers.
class Drawing {
 public:
  Drawing(int width_px, int height_px, double background)
      : width_(width_px), height_(height_px), light_(static_cast<std::size_t>(width_px * height_px), background) {}

  void fill(const TrueEllipse& e, double value) {
    const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
    const auto inside = [&](double u, double v) {
      const double x = (c * (u - e.cx_px) + s * (v - e.cy_px)) / e.a_px;
      const double y = (c * (v - e.cy_px) - s * (u - e.cx_px)) / e.b_px;
      return x * x + y * y < 1.0;
    };
    fill_within({e.cx_px - e.a_px, e.cy_px - e.a_px}, {e.cx_px + e.a_px, e.cy_px + e.a_px}, value, inside);
  }
  void fill(const Polygon& polygon, double value) {
    std::array<double, 2> low = polygon.corners_px.front(), high = low;
    for (const auto& p : polygon.corners_px) {
      low = {std::min(low[0], p[0]), std::min(low[1], p[1])};
      high = {std::max(high[0], p[0]), std::max(high[1], p[1])};
    }
    fill_within(low, high, value, [&](double u, double v) { return polygon.covers({}, u, v); });
  }
  std::vector<std::uint16_t> image(const Imaging& imaging, std::mt19937_64& random) const {
    return photographed(light_, width_, height_, imaging, random);
  }
  int width_px() const { return width_; }
  int height_px() const { return height_; }

 private:
  template <class Inside>
  void fill_within(std::array<double, 2> low, std::array<double, 2> high, double value, Inside&& inside) {
    constexpr int kPlaces = 8;
    const auto first = [](double x) { return std::max(0, static_cast<int>(std::floor(std::max(x, -1.0))) - 1); };
    const auto last = [](double x, int side) { return std::min(side - 1, static_cast<int>(std::min(x, 1e6)) + 1); };
    for (int v = first(low[1]); v <= last(high[1], height_); ++v) {
      for (int u = first(low[0]); u <= last(high[0], width_); ++u) {
        const bool corner = inside(u - 0.5, v - 0.5);
        const bool plain = corner == inside(u + 0.5, v - 0.5) && corner == inside(u - 0.5, v + 0.5) &&
                           corner == inside(u + 0.5, v + 0.5) && corner == inside(u, v);
        int covered = plain && corner ? kPlaces * kPlaces : 0;
        for (int k = 0; !plain && k < kPlaces * kPlaces; ++k) {
          const int row = k / kPlaces;
          const double x = (k % kPlaces + 0.5) / kPlaces - 0.5, y = (row + 0.5) / kPlaces - 0.5;
          covered += inside(u + x, v + y) ? 1 : 0;
        }
        const double part = static_cast<double>(covered) / (kPlaces * kPlaces);
        double& light = light_[static_cast<std::size_t>(v * width_ + u)];
        light += part * (value - light);
      }
    }
  }

  int width_, height_;
  std::vector<double> light_;
};

/// Fraction of an outline that lies in the image, at least 3.5 px from its border: what edges can show.
inline double fraction_in_image(const TrueEllipse& e, int width_px, int height_px) {
  constexpr int kPlaces = 180;
  constexpr double kBorder_px = 3.5;
  const double c = std::cos(e.theta_rad), s = std::sin(e.theta_rad);
  int seen = 0;
  for (int k = 0; k < kPlaces; ++k) {
    const double t = 2.0 * std::numbers::pi * k / kPlaces;
    const double x = e.a_px * std::cos(t), y = e.b_px * std::sin(t);
    const double u = e.cx_px + c * x - s * y, v = e.cy_px + s * x + c * y;
    const bool in = u > kBorder_px && v > kBorder_px && u < width_px - 1 - kBorder_px && v < height_px - 1 - kBorder_px;
    seen += in ? 1 : 0;
  }
  return static_cast<double>(seen) / kPlaces;
}

/// Sheets of dots or rings before a pinhole camera.
struct SheetSet {
  PaintedCamera camera{1024, 768, 900.0};
  int columns = 10, rows = 7;
  bool rings = false;
  double max_tilt_deg = 50.0;
  double min_radius_px = 6.0, max_radius_px = 24.0;  ///< of the dots at the sheet's middle
  double noise = 1.0;                                ///< as in RingSet
};

class SheetGenerator {
 public:
  SheetGenerator(const SheetSet& set, std::uint64_t seed) : set_(set), random_(seed) {}

  RingImage next() {
    RingImage image;
    Drawing drawing(set_.camera.width_px, set_.camera.height_px, uniform(0.2, 0.45));
    draw_sheet(drawing, image);
    Imaging imaging;
    imaging.blur_px = uniform(0.5, 1.0);
    imaging.full_well_e /= set_.noise * set_.noise;
    imaging.read_noise_e /= set_.noise;
    image.pixels = drawing.image(imaging, random_);
    return image;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  void draw_sheet(Drawing& drawing, RingImage& image) {
    const double tilt = uniform(0.0, set_.max_tilt_deg) * std::numbers::pi / 180.0, turn = uniform(-0.3, 0.3);
    const Vec3 right = {std::cos(tilt) * std::cos(turn), std::sin(turn), std::sin(tilt) * std::cos(turn)};
    const Vec3 down = {-std::cos(tilt) * std::sin(turn), std::cos(turn), -std::sin(tilt) * std::sin(turn)};
    const Vec3 normal = {std::sin(tilt), 0.0, -std::cos(tilt)};
    // Dots of radius 1 at a pitch of 3.2: the range makes their size.
    const double range = set_.camera.focal_px / uniform(set_.min_radius_px, set_.max_radius_px), pitch = 3.2;
    const Vec3 middle = {uniform(-0.25, 0.25) * range, uniform(-0.15, 0.15) * range, range};
    const auto at = [&](double column, double row) {
      Vec3 p = middle;
      for (std::size_t i = 0; i < 3; ++i) p[i] += pitch * (column * right[i] + row * down[i]);
      return p;
    };
    const double half_width = 0.5 * set_.columns + 0.3, half_height = 0.5 * set_.rows + 0.3;
    Polygon sheet;
    for (const auto& [x, y] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
      const Vec3 p = at(x * half_width, y * half_height);
      if (p[2] < 0.1 * range) return;
      sheet.corners_px.push_back({set_.camera.cx_px() + set_.camera.focal_px * p[0] / p[2],
                                  set_.camera.cy_px() + set_.camera.focal_px * p[1] / p[2]});
    }
    const double paper = uniform(0.6, 0.9), ink = uniform(0.03, 0.15), hole = uniform(0.35, 0.75);
    drawing.fill(sheet, paper);
    for (int k = 0; k < set_.columns * set_.rows; ++k) {
      const int row = k / set_.columns;
      const Vec3 centre = at(k % set_.columns - 0.5 * (set_.columns - 1), row - 0.5 * (set_.rows - 1));
      add(drawing, image, {centre, normal, 1.0}, ink);
      if (set_.rings) add(drawing, image, {centre, normal, hole}, paper);
    }
  }
  void add(Drawing& drawing, RingImage& image, const Disc& disc, double value) {
    const TrueEllipse outline = disc.outline(set_.camera);
    const double visible = fraction_in_image(outline, set_.camera.width_px, set_.camera.height_px);
    if (visible == 0.0) return;
    drawing.fill(outline, value);
    image.truth.push_back({outline, visible});
  }

  SheetSet set_;
  std::mt19937_64 random_;
};

}  // namespace pharos::test
