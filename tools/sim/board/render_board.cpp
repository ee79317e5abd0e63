// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/board/render_board.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/render/primitives.hpp"
#include "tools/sim/render/subpixels.hpp"

namespace pharos::sim {
namespace {

// Rays over what a pixel sees, where an edge crosses it; and a side of the glance that tells.
constexpr int kRays = 1024;
constexpr int kGlancesASide = 5;

// Fractions of the kinds of surface that a pixel sees; the rest is dark.
struct Seen {
  double bright = 0.0;
  double surround = 0.0;
};

enum class Surface { kDark, kBright, kSurround };

Seen all_of(Surface surface) {
  return {surface == Surface::kBright ? 1.0 : 0.0, surface == Surface::kSurround ? 1.0 : 0.0};
}

int nearest(double place, int count) { return std::clamp(static_cast<int>(place + 0.5), 0, count - 1); }

// The sheet before a camera. Its plane's coordinates are in pitches.
class Board {
 public:
  Board(const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T)
      : sheet_(sheet), plane_(T.t, sheet.pitch_m * T.R.col(0), sheet.pitch_m * T.R.col(1)) {}

  Surface seen_along(const Vector2& ray) const {
    const Vector3 direction(ray.x(), ray.y(), 1.0);
    const double depth = plane_.depth(direction);
    return at(plane_.s(direction, depth), plane_.t(direction, depth));
  }

 private:
  Surface at(double x, double y) const {
    // A dots' sheet ends one pitch beyond its dots, a chessboard's white margin half a square beyond its squares.
    const double margin = sheet_.dots ? 1.0 : 1.5;
    if (x < -margin || y < -margin || x > sheet_.columns - 1 + margin || y > sheet_.rows - 1 + margin) {
      return Surface::kSurround;
    }
    if (!sheet_.dots) {
      if (x < -1.0 || y < -1.0 || x > sheet_.columns || y > sheet_.rows) return Surface::kBright;
      const auto square = static_cast<int>(x + 1.0) + static_cast<int>(y + 1.0);
      return square % 2 == 0 ? Surface::kDark : Surface::kBright;
    }
    const int column = nearest(x, sheet_.columns), row = nearest(y, sheet_.rows);
    if (row * sheet_.columns + column == sheet_.missing) return Surface::kDark;
    const double dx = (x - column) * sheet_.pitch_m, dy = (y - row) * sheet_.pitch_m;
    return dx * dx + dy * dy < sheet_.radius_m * sheet_.radius_m ? Surface::kBright : Surface::kDark;
  }

  const BoardSheet& sheet_;
  PlaneCoordinates plane_;
};

// What a pixel sees. Its rays lie between (and, for blur, a little beyond) its four corners' bilinearly: the lens bends
// less than 1e-5 px over that.
class Pixel {
 public:
  Pixel(const Vector2* upper, const Vector2* lower) : upper_(upper), lower_(lower) {}

  Seen look(const Board& board, const std::vector<Subpixel>& subpixels) const {
    Seen sum;
    for (const Subpixel& subpixel : subpixels) {
      const Surface surface = board.seen_along(ray(subpixel));
      sum.bright += surface == Surface::kBright ? 1.0 : 0.0;
      sum.surround += surface == Surface::kSurround ? 1.0 : 0.0;
    }
    const auto count = static_cast<double>(subpixels.size());
    return {sum.bright / count, sum.surround / count};
  }

  bool is_even(const Board& board, double reach_px) const {
    const Surface first = middle(board);
    const auto step = [reach_px](int i) { return reach_px * (2.0 * i / (kGlancesASide - 1.0) - 1.0); };
    for (int j = 0; j < kGlancesASide; ++j) {
      for (int i = 0; i < kGlancesASide; ++i) {
        if (board.seen_along(ray({step(i), step(j)})) != first) return false;
      }
    }
    return true;
  }

  Surface middle(const Board& board) const { return board.seen_along(ray({0.0, 0.0})); }

 private:
  Vector2 ray(const Subpixel& subpixel) const {
    const double s = subpixel[0] + 0.5, t = subpixel[1] + 0.5;
    return (1.0 - t) * ((1.0 - s) * upper_[0] + s * upper_[1]) + t * ((1.0 - s) * lower_[0] + s * lower_[1]);
  }

  const Vector2* upper_;
  const Vector2* lower_;
};

void darken_corners(LinearImage& image, double falloff) {
  if (falloff == 0.0) return;
  const double half_u = 0.5 * image.width_px, half_v = 0.5 * image.height_px;
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    for (std::int32_t u = 0; u < image.width_px; ++u) {
      const double du = u - half_u, dv = v - half_v;
      const double outwards = (du * du + dv * dv) / (half_u * half_u + half_v * half_v);
      image.at(u, v) *= static_cast<float>(1.0 - falloff * outwards);
    }
  }
}

}  // namespace

host::GreyImage BoardRenderer::render(const BoardSheet& sheet, const Pose<frame::Camera, frame::Board>& T_camera_board,
                                      const Exposure& exposure, std::uint64_t seed) const {
  const Board board(sheet, T_camera_board);
  const std::vector<Subpixel> subpixels = blurred_subpixels(kRays, exposure.blur_px);
  const double reach_px = blurred_subpixel_reach(exposure.blur_px);
  // Light 1 is the largest count.
  const double top = exposure.bits == 8 ? 255.0 : 65535.0;
  LinearImage image{lens_.width_px, lens_.height_px, {}};
  image.light.reserve(static_cast<std::size_t>(lens_.width_px) * static_cast<std::size_t>(lens_.height_px));
  for (int v = 0; v < lens_.height_px; ++v) {
    for (int u = 0; u < lens_.width_px; ++u) {
      const Pixel pixel(corners_.row_begin(v, u), corners_.row_begin(v + 1, u));
      const Seen seen = pixel.is_even(board, reach_px) ? all_of(pixel.middle(board)) : pixel.look(board, subpixels);
      const double counts = exposure.dark + seen.bright * (exposure.bright - exposure.dark) +
                            seen.surround * (exposure.surround - exposure.dark);
      image.light.push_back(static_cast<float>(counts / top));
    }
  }
  darken_corners(image, exposure.falloff);
  RandomStream noise(seed, "board pixels");
  return expose(image,
                {.full_well_e = top,
                 .read_noise_e = exposure.noise,
                 .electrons_per_light = top,
                 .bits = exposure.bits,
                 .shot_noise = false},
                noise);
}

}  // namespace pharos::sim
