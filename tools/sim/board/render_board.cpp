// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/board/render_board.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "tools/sim/random_stream.hpp"

namespace pharos::sim {
namespace {

// Rays over what a pixel sees, where an edge crosses it; and a side of the glance that tells.
constexpr int kRays = 1024;
constexpr int kGlancesASide = 5;
// A Gaussian blur beyond this many sigma is left out.
constexpr double kBlurReach = 3.5;

double integral_of_normal(double x) {
  const double density = std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
  return x * 0.5 * std::erfc(-x / std::numbers::sqrt2) + density;
}

// Fraction of a pixel's light, its own width blurred, that comes from left of `x` (from its middle).
double fraction_left_of(double x, double blur_px) {
  if (blur_px <= 0.0) return std::clamp(x + 0.5, 0.0, 1.0);
  return blur_px * (integral_of_normal((x + 0.5) / blur_px) - integral_of_normal((x - 0.5) / blur_px));
}

double place_of_fraction(double fraction, double blur_px) {
  double low = -0.5 - kBlurReach * blur_px, high = -low;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (fraction_left_of(middle, blur_px) < fraction ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Where in a pixel, from its middle, rays of the same weight pass: an even sequence (Roberts' R2) rather than a grid,
// which would jump where an edge runs along it, and its mirror image, so that nothing is moved.
std::vector<std::array<double, 2>> aperture(double blur_px) {
  constexpr double kPlastic = 1.32471795724474602596;
  std::vector<std::array<double, 2>> rays;
  for (int i = 1; i <= kRays / 2; ++i) {
    const auto fraction = [&](double step) { return std::fmod(0.5 + step * i, 1.0); };
    const double s = place_of_fraction(fraction(1.0 / kPlastic), blur_px);
    const double t = place_of_fraction(fraction(1.0 / (kPlastic * kPlastic)), blur_px);
    rays.push_back({s, t});
    rays.push_back({-s, -t});
  }
  return rays;
}

// The shares of the three kinds of surface that a ray can meet.
struct Fractions {
  double bright = 0.0;
  double surround = 0.0;
};

// Where a distorted point (in focal lengths) came from: the usual fixed point, x = (x' - tangential) / radial.
std::array<double, 2> ideal_of(const Lens& lens, double xd, double yd) {
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  double x = xd, y = yd;
  for (int round = 0; round < 200; ++round) {
    const double r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
    const double next_x = (xd - 2.0 * p1 * x * y - p2 * (r2 + 2.0 * x * x)) / radial;
    const double next_y = (yd - p1 * (r2 + 2.0 * y * y) - 2.0 * p2 * x * y) / radial;
    const double step = std::abs(next_x - x) + std::abs(next_y - y);
    x = next_x;
    y = next_y;
    if (step < 1e-15) break;
  }
  return {x, y};
}

// Board coordinates of a ray: the plane's homography, turned round.
class Plane {
 public:
  explicit Plane(const Pose<frame::Camera, frame::Board>& T) {
    Matrix3 H;
    H << T.R.col(0), T.R.col(1), T.t;
    inverse_ = H.inverse();
  }
  std::array<double, 2> at(double x, double y) const {
    const Vector3 h = inverse_ * Vector3(x, y, 1.0);
    return {h.x() / h.z(), h.y() / h.z()};
  }

 private:
  Matrix3 inverse_;
};

enum class Surface { kDark, kBright, kSurround };

int nearest(double place, int count) { return std::clamp(static_cast<int>(place + 0.5), 0, count - 1); }

Surface surface_at(const BoardSheet& sheet, const std::array<double, 2>& point_m) {
  const double x = point_m[0] / sheet.pitch_m, y = point_m[1] / sheet.pitch_m;
  // A dots' sheet ends one pitch beyond its dots, a chessboard's white margin half a square beyond its squares.
  const double margin = sheet.dots ? 1.0 : 1.5;
  if (x < -margin || y < -margin || x > sheet.columns - 1 + margin || y > sheet.rows - 1 + margin) {
    return Surface::kSurround;
  }
  if (!sheet.dots) {
    if (x < -1.0 || y < -1.0 || x > sheet.columns || y > sheet.rows) return Surface::kBright;
    const auto square = static_cast<int>(x + 1.0) + static_cast<int>(y + 1.0);
    return square % 2 == 0 ? Surface::kDark : Surface::kBright;
  }
  const int column = nearest(x, sheet.columns), row = nearest(y, sheet.rows);
  if (row * sheet.columns + column == sheet.missing) return Surface::kDark;
  const double dx = (x - column) * sheet.pitch_m, dy = (y - row) * sheet.pitch_m;
  return dx * dx + dy * dy < sheet.radius_m * sheet.radius_m ? Surface::kBright : Surface::kDark;
}

// What a pixel sees. Its rays lie between (and, for blur, a little beyond) its four corners' bilinearly: the lens bends
// less than 1e-5 px over that.
class Pixel {
 public:
  Pixel(const std::array<double, 2>* upper, const std::array<double, 2>* lower) : upper_(upper), lower_(lower) {}

  Fractions look(const BoardSheet& sheet, const Plane& plane, const std::vector<std::array<double, 2>>& rays) const {
    Fractions fractions;
    for (const auto& [s, t] : rays) {
      const Surface surface = surface_at(sheet, ray(plane, s + 0.5, t + 0.5));
      fractions.bright += surface == Surface::kBright ? 1.0 : 0.0;
      fractions.surround += surface == Surface::kSurround ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(rays.size());
    return {fractions.bright / count, fractions.surround / count};
  }

  bool is_even(const BoardSheet& sheet, const Plane& plane, double blur_px) const {
    const double reach = 0.5 + kBlurReach * blur_px;
    const Surface first = surface_at(sheet, ray(plane, 0.5, 0.5));
    for (int j = 0; j < kGlancesASide; ++j) {
      for (int i = 0; i < kGlancesASide; ++i) {
        const double s = reach * (2.0 * i / (kGlancesASide - 1.0) - 1.0),
                     t = reach * (2.0 * j / (kGlancesASide - 1.0) - 1.0);
        if (surface_at(sheet, ray(plane, s + 0.5, t + 0.5)) != first) return false;
      }
    }
    return true;
  }

  Surface middle(const BoardSheet& sheet, const Plane& plane) const { return surface_at(sheet, ray(plane, 0.5, 0.5)); }

 private:
  std::array<double, 2> ray(const Plane& plane, double s, double t) const {
    const auto mix = [&](std::size_t k) {
      return (1.0 - t) * ((1.0 - s) * upper_[0][k] + s * upper_[1][k]) +
             t * ((1.0 - s) * lower_[0][k] + s * lower_[1][k]);
    };
    return plane.at(mix(0), mix(1));
  }

  const std::array<double, 2>* upper_;
  const std::array<double, 2>* lower_;
};

Fractions fractions_of(const Pixel& pixel, const BoardSheet& sheet, const Plane& plane,
                       const std::vector<std::array<double, 2>>& rays, double blur_px) {
  if (!pixel.is_even(sheet, plane, blur_px)) return pixel.look(sheet, plane, rays);
  const Surface surface = pixel.middle(sheet, plane);
  return {surface == Surface::kBright ? 1.0 : 0.0, surface == Surface::kSurround ? 1.0 : 0.0};
}

BoardImage exposed(const Lens& lens, const std::vector<double>& light, const Exposure& exposure, std::uint64_t seed) {
  BoardImage image{lens.width_px, lens.height_px, std::vector<std::uint16_t>(light.size())};
  RandomStream noise(seed, "board pixels");
  const double top = exposure.bits == 8 ? 255.0 : 65535.0;
  const double half_u = 0.5 * lens.width_px, half_v = 0.5 * lens.height_px;
  std::size_t at = 0;
  for (int v = 0; v < lens.height_px; ++v) {
    for (int u = 0; u < lens.width_px; ++u, ++at) {
      const double du = u - half_u, dv = v - half_v;
      const double fraction = (du * du + dv * dv) / (half_u * half_u + half_v * half_v);
      const double counts = light[at] * (1.0 - exposure.falloff * fraction) + exposure.noise * noise.normal();
      image.pixels[at] = static_cast<std::uint16_t>(std::lround(std::clamp(counts, 0.0, top)));
    }
  }
  return image;
}

}  // namespace

std::array<double, 2> pixel_of(const Lens& lens, const Vector3& point_camera_m) {
  const auto& [k1, k2, p1, p2, k3] = lens.distortion;
  const double x = point_camera_m.x() / point_camera_m.z(), y = point_camera_m.y() / point_camera_m.z();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  const double xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
  const double yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
  return {lens.fx_px * xd + lens.cx_px, lens.fy_px * yd + lens.cy_px};
}

BoardRenderer::BoardRenderer(const Lens& lens) : lens_(lens) {
  corner_.reserve(static_cast<std::size_t>(lens.width_px + 1) * static_cast<std::size_t>(lens.height_px + 1));
  for (int v = 0; v <= lens.height_px; ++v) {
    for (int u = 0; u <= lens.width_px; ++u) {
      corner_.push_back(ideal_of(lens, (u - 0.5 - lens.cx_px) / lens.fx_px, (v - 0.5 - lens.cy_px) / lens.fy_px));
    }
  }
}

BoardImage BoardRenderer::render(const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T_camera_board,
                                 const Exposure& exposure, std::uint64_t seed) const {
  const Plane plane(T_camera_board);
  const std::vector<std::array<double, 2>> rays = aperture(exposure.blur_px);
  const int across = lens_.width_px + 1;
  std::vector<double> light;
  light.reserve(static_cast<std::size_t>(lens_.width_px) * static_cast<std::size_t>(lens_.height_px));
  for (int v = 0; v < lens_.height_px; ++v) {
    for (int u = 0; u < lens_.width_px; ++u) {
      const std::array<double, 2>* upper = corner_.data() + static_cast<std::ptrdiff_t>(v) * across + u;
      const Fractions fractions = fractions_of(Pixel(upper, upper + across), sheet, plane, rays, exposure.blur_px);
      light.push_back(exposure.dark + fractions.bright * (exposure.bright - exposure.dark) +
                      fractions.surround * (exposure.surround - exposure.dark));
    }
  }
  return exposed(lens_, light, exposure, seed);
}

}  // namespace pharos::sim
