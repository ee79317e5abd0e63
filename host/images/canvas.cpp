// SPDX-License-Identifier: Apache-2.0
#include "host/images/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/images/letters.hpp"
#include "host/images/png_format.hpp"

namespace pharos::host {
namespace {

constexpr double kBrightest = 200.0;  // of the grey ground
constexpr double kAway = 30000.0;     // nothing is drawn from or to farther places

// The value that `share` of the pixels stay below.
std::uint16_t percentile(const std::vector<std::uint16_t>& sorted, double fraction) {
  return sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))];
}

struct Stretch {
  double low = 0.0, per_value = 0.0;

  explicit Stretch(ImageView<const std::uint16_t> image) {
    std::vector<std::uint16_t> sample;
    const std::size_t step = 1 + image.pixels() / 100'000;
    for (std::size_t k = 0; k < image.pixels(); k += step) {
      const auto width = static_cast<std::size_t>(image.width_px);
      sample.push_back(image.at(static_cast<std::int32_t>(k % width), static_cast<std::int32_t>(k / width)));
    }
    if (sample.empty()) return;
    std::sort(sample.begin(), sample.end());
    low = percentile(sample, 0.01);
    per_value = kBrightest / std::max(1.0, percentile(sample, 0.995) - low);
  }
  std::uint8_t operator()(std::uint16_t value) const {
    return static_cast<std::uint8_t>(std::clamp((value - low) * per_value, 0.0, kBrightest));
  }
};

}  // namespace

Canvas::Canvas(ImageView<const std::uint16_t> image, int zoom)
    : width_(image.width_px * zoom), height_(image.height_px * zoom), zoom_(zoom) {
  const Stretch stretch(image);
  rgb_.resize(3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  std::size_t at = 0;
  for (std::int32_t y = 0; y < height_; ++y) {
    for (std::int32_t x = 0; x < width_; ++x) {
      const std::uint8_t grey = stretch(image.at(x / zoom, y / zoom));
      for (int k = 0; k < 3; ++k) rgb_[at++] = grey;
    }
  }
}

int Canvas::zoom_for(std::int32_t width_px) { return std::clamp(1280 / std::max(1, width_px), 1, 8); }

Colour Canvas::pixel(std::int32_t x, std::int32_t y) const {
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  return {rgb_[at], rgb_[at + 1], rgb_[at + 2]};
}

void Canvas::blend(std::int32_t x, std::int32_t y, Colour colour, double fraction) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_ || fraction <= 0.0) return;
  const double kept = 1.0 - std::min(1.0, fraction);
  const std::size_t at =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  const std::array<std::uint8_t, 3> over = {colour.red, colour.green, colour.blue};
  for (std::size_t k = 0; k < 3; ++k) {
    rgb_[at + k] = static_cast<std::uint8_t>(kept * rgb_[at + k] + (1.0 - kept) * over[k] + 0.5);
  }
}

// Each pixel by its distance from the line: edges are smooth without further care.
void Canvas::stroke(Spot a, Spot b, Colour colour, double width) {
  for (const double value : {a.x, a.y, b.x, b.y}) {
    if (!(std::abs(value) < kAway)) return;
  }
  const double half = 0.5 * width, reach = half + 1.0;
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const auto low = [&](double p, double q) {
    return std::max(0, static_cast<std::int32_t>(std::floor(std::min(p, q) - reach)));
  };
  const auto high = [&](double p, double q, std::int32_t end) {
    return std::min(end - 1, static_cast<std::int32_t>(std::ceil(std::max(p, q) + reach)));
  };
  for (std::int32_t y = low(a.y, b.y); y <= high(a.y, b.y, height_); ++y) {
    for (std::int32_t x = low(a.x, b.x); x <= high(a.x, b.x, width_); ++x) {
      const double along = squared > 0.0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
      blend(x, y, colour, half + 0.5 - std::hypot(x - a.x - along * dx, y - a.y - along * dy));
    }
  }
}

void Canvas::line(Place from, Place to, Colour colour, double width) {
  // In pieces: the box around a slanted piece stays small.
  const Spot a = spot(from), b = spot(to);
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (!(length < 2.0 * kAway)) return;
  const int pieces = std::max(1, static_cast<int>(length / 16.0));
  for (int k = 0; k < pieces; ++k) {
    const double p = static_cast<double>(k) / pieces, q = static_cast<double>(k + 1) / pieces;
    stroke({a.x + p * (b.x - a.x), a.y + p * (b.y - a.y)}, {a.x + q * (b.x - a.x), a.y + q * (b.y - a.y)}, colour,
           width);
  }
}

void Canvas::polyline(std::span<const Place> places, Colour colour, double width) {
  for (std::size_t k = 1; k < places.size(); ++k) line(places[k - 1], places[k], colour, width);
}

void Canvas::ellipse(Place centre, double a_px, double b_px, double theta_rad, Colour colour, double width,
                     bool dashed) {
  if (!std::isfinite(a_px)) return;
  const int pieces = 2 * static_cast<int>(std::clamp(a_px * zoom_ / 4.0, 24.0, 1000.0));
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  const auto place = [&](int k) {
    const double t = 2.0 * std::numbers::pi * k / pieces, x = a_px * std::cos(t), y = b_px * std::sin(t);
    return Place{centre.u_px + c * x - s * y, centre.v_px + s * x + c * y};
  };
  for (int k = 0; k < pieces; ++k) {
    if (!dashed || k % 2 == 0) stroke(spot(place(k)), spot(place(k + 1)), colour, width);
  }
}

void Canvas::arrow(Place from, Place to, Colour colour, double width) {
  line(from, to, colour, width);
  const double du = to.u_px - from.u_px, dv = to.v_px - from.v_px, length = std::hypot(du, dv);
  if (!(length > 0.0)) return;
  const double head = 5.0 * width / zoom_;
  for (const double side : {-0.5, 0.5}) {
    line(to, {to.u_px - head * (du - side * dv) / length, to.v_px - head * (dv + side * du) / length}, colour, width);
  }
}

void Canvas::dot(Place at, Colour colour, double radius) { stroke(spot(at), spot(at), colour, 2.0 * radius); }

void Canvas::cross(Place at, Colour colour, double half) {
  const Spot s = spot(at);
  stroke({s.x - half, s.y}, {s.x + half, s.y}, colour, 1.5);
  stroke({s.x, s.y - half}, {s.x, s.y + half}, colour, 1.5);
}

void Canvas::tint(std::int32_t u, std::int32_t v, Colour colour, double fraction) {
  for (int dy = 0; dy < zoom_; ++dy) {
    for (int dx = 0; dx < zoom_; ++dx) blend(u * zoom_ + dx, v * zoom_ + dy, colour, fraction);
  }
}

void Canvas::text(Place at, std::string_view words, Colour colour, int size) {
  const Spot corner = spot(at);
  if (!(std::abs(corner.x) < kAway) || !(std::abs(corner.y) < kAway)) return;
  const auto left = static_cast<std::int32_t>(corner.x), top = static_cast<std::int32_t>(corner.y);
  const auto across = static_cast<std::int32_t>(words.size()) * 6 * size;
  constexpr double kGround = 0.6;
  for (std::int32_t y = -size; y < 8 * size; ++y) {
    for (std::int32_t x = -size; x < across; ++x) blend(left + x, top + y, colours::kBlack, kGround);
  }
  for (std::size_t k = 0; k < words.size(); ++k) {
    const Letter& letter = letter_of(words[k]);
    for (int x = 0; x < 5 * size; ++x) {
      for (int y = 0; y < 7 * size; ++y) {
        const bool inked = (letter[static_cast<std::size_t>(x / size)] >> (y / size) & 1) != 0;
        if (inked) blend(left + static_cast<std::int32_t>(k) * 6 * size + x, top + y, colour, 1.0);
      }
    }
  }
}

void Canvas::write_png(const std::string& path) const {
  host::write_png(path, width_, height_, PngPixels::kRgb8, rgb_);
}

}  // namespace pharos::host
