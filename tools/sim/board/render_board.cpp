// SPDX-License-Identifier: Apache-2.0
#include "tools/sim/board/render_board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/sim/optics/image_sensor.hpp"
#include "tools/sim/render/primitives.hpp"
#include "tools/sim/render/subpixels.hpp"

namespace pharos::sim {
namespace {

// Rays over what a pixel sees, where an edge crosses it; and a side of the glance that tells.
constexpr int kRays = 1024;
constexpr int kGlancesASide = 5;
constexpr double kRounding = 1e-9;  // pitches

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
    const Vector2 place = place_along(ray);
    return at(place.x(), place.y());
  }

  // The one surface between these rays, where it is plain to see that there is no other: nearly all pixels.
  std::optional<Surface> only_surface(const std::array<Vector2, 4>& rays) const {
    Vector2 low = Vector2::Constant(kNever), high = -low;
    for (const Vector2& ray : rays) {
      if (!(plane_.depth({ray.x(), ray.y(), 1.0}) > 0.0)) return std::nullopt;
      const Vector2 place = place_along(ray);
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
    low.array() -= kRounding;
    high.array() += kRounding;
    const Surface first = at(low.x(), low.y());
    return is_within_one(low, high) ? std::optional(first) : std::nullopt;
  }

 private:
  Vector2 place_along(const Vector2& ray) const {
    const Vector3 direction(ray.x(), ray.y(), 1.0);
    const double depth = plane_.depth(direction);
    return {plane_.s(direction, depth), plane_.t(direction, depth)};
  }

  // Whether the rectangle is on one side of every border.
  bool is_within_one(const Vector2& low, const Vector2& high) const {
    const double margin = sheet_.dots ? 1.0 : 1.5;
    const Vector2 end(sheet_.columns - 1 + margin, sheet_.rows - 1 + margin);
    if ((high.array() < -margin).any() || (low.array() > end.array()).any()) return true;
    if ((low.array() < -margin).any() || (high.array() > end.array()).any()) return false;
    if (!sheet_.dots) {
      if ((low.array() < -1.0).any() || high.x() > sheet_.columns || high.y() > sheet_.rows) return false;
      return static_cast<int>(low.x() + 1.0) == static_cast<int>(high.x() + 1.0) &&
             static_cast<int>(low.y() + 1.0) == static_cast<int>(high.y() + 1.0);
    }
    const Vector2 dot(nearest(low.x(), sheet_.columns), nearest(low.y(), sheet_.rows));
    if (dot.x() != nearest(high.x(), sheet_.columns) || dot.y() != nearest(high.y(), sheet_.rows)) return false;
    const Vector2 closest = dot.cwiseMax(low).cwiseMin(high), farthest = (dot - low).cwiseMax(high - dot);
    const double radius = sheet_.radius_m / sheet_.pitch_m;
    return (closest - dot).norm() > radius + kRounding || farthest.norm() < radius - kRounding;
  }

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

// The places of a pixel's rays in groups of neighbours, so that those off every border are counted at once.
class RayGroups {
 public:
  struct Group {
    std::array<Subpixel, 4> corners;
    std::size_t first = 0, count = 0;
    std::vector<Group> parts;  // four; none: its rays one by one
  };

  explicit RayGroups(std::vector<Subpixel> places) : places_(std::move(places)), all_(grouped(0, places_.size())) {}
  const Group& all() const { return all_; }
  std::span<const Subpixel> places(const Group& group) const {
    return std::span(places_).subspan(group.first, group.count);
  }

 private:
  static constexpr std::size_t kFewest = 16;

  void split(std::size_t first, std::size_t count, std::size_t axis) {
    const auto begin = places_.begin() + static_cast<std::ptrdiff_t>(first);
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(count / 2), begin + static_cast<std::ptrdiff_t>(count),
                     [axis](const Subpixel& a, const Subpixel& b) { return a[axis] < b[axis]; });
  }

  Group grouped(std::size_t first, std::size_t count) {
    Group group{{}, first, count, {}};
    if (count > kFewest) {
      const std::size_t half = count / 2, quarter = half / 2;
      split(first, count, 0);
      split(first, half, 1);
      split(first + half, count - half, 1);
      group.parts = {grouped(first, quarter), grouped(first + quarter, half - quarter),
                     grouped(first + half, (count - half) / 2),
                     grouped(first + half + (count - half) / 2, count - half - (count - half) / 2)};
    }
    Subpixel low{kNever, kNever}, high{-kNever, -kNever};
    for (const Subpixel& place : places(group)) {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis]);
      }
    }
    group.corners = {low, {high[0], low[1]}, {low[0], high[1]}, high};
    return group;
  }

  std::vector<Subpixel> places_;
  Group all_;
};

// What a pixel sees. Its rays lie between (and, for blur, a little beyond) its four corners' bilinearly: the lens bends
// less than 1e-5 px over that.
class Pixel {
 public:
  Pixel(const Vector2* upper, const Vector2* lower) : upper_(upper), lower_(lower) {}

  Seen look(const Board& board, const RayGroups& rays) const {
    Seen sum;
    count(board, rays, rays.all(), sum);
    const auto all = static_cast<double>(rays.all().count);
    return {sum.bright / all, sum.surround / all};
  }

  std::optional<Surface> only_surface(const Board& board, double reach_px) const {
    const double r = reach_px;
    return only_surface(board, {{{-r, -r}, {r, -r}, {-r, r}, {r, r}}});
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
  std::optional<Surface> only_surface(const Board& board, const std::array<Subpixel, 4>& corners) const {
    return board.only_surface({ray(corners[0]), ray(corners[1]), ray(corners[2]), ray(corners[3])});
  }

  static void add(Surface surface, std::size_t rays, Seen& sum) {
    if (surface == Surface::kBright) sum.bright += static_cast<double>(rays);
    if (surface == Surface::kSurround) sum.surround += static_cast<double>(rays);
  }

  void count(const Board& board, const RayGroups& rays, const RayGroups::Group& group, Seen& sum) const {
    if (const auto only = only_surface(board, group.corners)) return add(*only, group.count, sum);
    for (const RayGroups::Group& part : group.parts) count(board, rays, part, sum);
    if (!group.parts.empty()) return;
    for (const Subpixel& place : rays.places(group)) add(board.seen_along(ray(place)), 1, sum);
  }

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
  const RayGroups groups(blurred_subpixels(kRays, exposure.blur_px));
  const double reach_px = blurred_subpixel_reach(exposure.blur_px);
  // Light 1 is the largest count.
  const double top = exposure.bits == 8 ? 255.0 : 65535.0;
  LinearImage image{lens_.width_px, lens_.height_px, {}};
  image.light.reserve(static_cast<std::size_t>(lens_.width_px) * static_cast<std::size_t>(lens_.height_px));
  for (int v = 0; v < lens_.height_px; ++v) {
    for (int u = 0; u < lens_.width_px; ++u) {
      const Pixel pixel(corners_.row_begin(v, u), corners_.row_begin(v + 1, u));
      const std::optional<Surface> only = pixel.only_surface(board, reach_px);
      const Seen seen = only                             ? all_of(*only)
                        : pixel.is_even(board, reach_px) ? all_of(pixel.middle(board))
                                                         : pixel.look(board, groups);
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
