// SPDX-License-Identifier: Apache-2.0
#include "host/images/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "host/images/jpeg_format.hpp"
#include "host/images/png_format.hpp"

namespace pharos::host {
namespace {

constexpr double kBrightest = 200.0;  // of the grey background
constexpr double kAway = 30000.0;     // points farther away than this are not drawn
constexpr int kFractionBits = 8;      // of OpenCV's coordinates: 1/256 px

// The value below which `fraction` of the pixels are.
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

cv::Scalar scalar(Colour colour) { return {1.0 * colour.red, 1.0 * colour.green, 1.0 * colour.blue}; }
// Smoothing adds about a pixel.
int thickness(double width) { return std::max(1, static_cast<int>(width)); }

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

// Runs `draw` with a cv::Mat over the pixels.
template <class Draw>
void Canvas::paint(Draw&& draw) {
  cv::Mat pixels(height_, width_, CV_8UC3, rgb_.data());
  draw(pixels);
}

// Blends the colour over the picture with weight `fraction` (1 covers), for the part of the rectangle within it.
void Canvas::cover(std::int32_t left, std::int32_t top, std::int32_t width, std::int32_t height, Colour colour,
                   double fraction) {
  const cv::Rect within = cv::Rect(left, top, width, height) & cv::Rect(0, 0, width_, height_);
  const double covered = std::clamp(fraction, 0.0, 1.0);
  const std::array<std::uint8_t, 3> over = {colour.red, colour.green, colour.blue};
  for (std::int32_t y = within.y; y < within.y + within.height; ++y) {
    for (std::int32_t x = within.x; x < within.x + within.width; ++x) {
      std::uint8_t* pixel =
          &rgb_[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x))];
      for (std::size_t k = 0; k < 3; ++k) {
        pixel[k] = static_cast<std::uint8_t>((1.0 - covered) * pixel[k] + covered * over[k] + 0.5);
      }
    }
  }
}

void Canvas::stroke(std::span<const Place> places, Colour colour, double width) {
  const auto fixed = [](double value) { return static_cast<int>(std::lround(value * (1 << kFractionBits))); };
  std::vector<cv::Point> run;
  const auto draw_run = [&] {
    paint([&](cv::Mat& pixels) {
      if (run.size() > 1) {
        cv::polylines(pixels, run, false, scalar(colour), thickness(width), cv::LINE_AA, kFractionBits);
      }
    });
    run.clear();
  };
  for (const Place& place : places) {
    const Spot at = spot(place);
    const bool near = std::abs(at.x) < kAway && std::abs(at.y) < kAway;
    if (near) run.emplace_back(fixed(at.x), fixed(at.y));
    if (!near) draw_run();
  }
  draw_run();
}

void Canvas::line(Place from, Place to, Colour colour, double width) {
  stroke(std::array<Place, 2>{from, to}, colour, width);
}

void Canvas::polyline(std::span<const Place> places, Colour colour, double width) { stroke(places, colour, width); }

// As a polygon: cv::ellipse rounds the angle to whole degrees.
void Canvas::ellipse(Place centre, double a_px, double b_px, double theta_rad, Colour colour, double width,
                     bool dashed) {
  if (!std::isfinite(a_px)) return;
  const int pieces = 2 * static_cast<int>(std::clamp(a_px * zoom_ / 4.0, 24.0, 1000.0));
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  std::vector<Place> places;
  for (int k = 0; k <= pieces; ++k) {
    const double t = 2.0 * std::numbers::pi * k / pieces, x = a_px * std::cos(t), y = b_px * std::sin(t);
    places.push_back({centre.u_px + c * x - s * y, centre.v_px + s * x + c * y});
  }
  if (!dashed) return stroke(places, colour, width);
  for (std::size_t k = 0; k + 1 < places.size(); k += 2) line(places[k], places[k + 1], colour, width);
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

void Canvas::dot(Place at, Colour colour, double radius) {
  const Spot s = spot(at);
  if (!(std::abs(s.x) < kAway) || !(std::abs(s.y) < kAway)) return;
  constexpr double kScale = 1 << kFractionBits;
  paint([&](cv::Mat& pixels) {
    const cv::Point centre(static_cast<int>(std::lround(s.x * kScale)), static_cast<int>(std::lround(s.y * kScale)));
    cv::circle(pixels, centre, static_cast<int>(std::lround(radius * kScale)), scalar(colour), cv::FILLED, cv::LINE_AA,
               kFractionBits);
  });
}

void Canvas::cross(Place at, Colour colour, double half) {
  const double reach = half / zoom_;
  line({at.u_px - reach, at.v_px}, {at.u_px + reach, at.v_px}, colour, 1.5);
  line({at.u_px, at.v_px - reach}, {at.u_px, at.v_px + reach}, colour, 1.5);
}

void Canvas::tint(std::int32_t u, std::int32_t v, Colour colour, double fraction) {
  if (u < 0 || v < 0 || u >= width_ / zoom_ || v >= height_ / zoom_) return;
  cover(u * zoom_, v * zoom_, zoom_, zoom_, colour, fraction);
}

void Canvas::text(Place at, std::string_view words, Colour colour, int size) {
  const Spot corner = spot(at);
  if (!(std::abs(corner.x) < kAway) || !(std::abs(corner.y) < kAway)) return;
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  const auto left = static_cast<std::int32_t>(corner.x), top = static_cast<std::int32_t>(corner.y);
  const int height = 7 * size, pen = thickness(0.5 * size);
  const double scale = cv::getFontScaleFromHeight(kFont, height, pen);
  const std::string line(words);
  int below = 0;
  const cv::Size box = cv::getTextSize(line, kFont, scale, pen, &below);
  constexpr double kGround = 0.6;
  cover(left - size, top - size, box.width + 2 * size, height + below + size, colours::kBlack, kGround);
  paint([&](cv::Mat& pixels) {
    cv::putText(pixels, line, {left, top + height}, kFont, scale, scalar(colour), pen, cv::LINE_AA);
  });
}

std::vector<std::uint8_t> Canvas::jpeg(int quality) const { return encode_jpeg(width_, height_, rgb_, quality); }

void Canvas::write_png(const std::string& path) const {
  host::write_png(path, width_, height_, PngPixels::kRgb8, rgb_);
}

}  // namespace pharos::host
