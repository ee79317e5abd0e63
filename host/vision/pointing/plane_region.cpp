// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/plane_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr int kBlocks = 6;    // along and across
constexpr int kSamples = 12;  // of a block, along and across
// Of the distance between the edges, and between the ends: blur, a frame and rounded corners are outside.
constexpr double kClearOfSides = 0.1;
constexpr double kClearOfEnds = 0.04;
// Below it blur reaches every block.
constexpr double kMinWidth_px = 16.0;
// Of a block's brightness over the sky from the middle one's. Two faces of a body whose light differs by less look like
// one plane.
constexpr double kMaxDeparture = 0.1;
// Beyond a side's end: foil differs from place to place, and a dark face has few grey values.
constexpr double kMaxDepartureBeyond = 0.2;
constexpr double kMinAlike = 0.85;  // of all blocks
// Along each edge, within this of the distance between the edges; one block for what a cell's border or a hinge
// darkens.
constexpr int kBlocksOfSide = 12;
constexpr int kMinAlikeOfSide = 11;
constexpr double kSideBand = 0.3;

double median_of(double* begin, double* end) {
  double* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  return *middle;
}

// Places of the strip: both coordinates from 0 to 1, along the pair and from one edge to the other.
class Strip {
 public:
  explicit Strip(const EdgePair& pair) : pair_(pair), across_(pair.middle.across()) {}

  Vector2 at(double along, double across) const {
    const Vector2 middle = pair_.middle.begin + along * (pair_.middle.end - pair_.middle.begin);
    const Vector2 one = on(pair_.first, middle), other = on(pair_.second, middle);
    return one + across * (other - one);
  }

 private:
  Vector2 on(const Segment& edge, const Vector2& middle) const {
    return middle - edge.offset(middle) / edge.across().dot(across_) * across_;
  }
  const EdgePair& pair_;
  Vector2 across_;
};

double grey_at(ImageView<const std::uint16_t> image, const Vector2& place) {
  const auto u = std::clamp(static_cast<std::int32_t>(std::lround(place.x())), 0, image.width_px - 1);
  const auto v = std::clamp(static_cast<std::int32_t>(std::lround(place.y())), 0, image.height_px - 1);
  return image.row(v)[u];
}

// Median of a block's samples; `place` tells where one is of its place in the block, from 0 to 1 along and across.
template <class Place>
double level_of_block(ImageView<const std::uint16_t> image, Place place) {
  std::array<double, kSamples * kSamples> grey{};
  std::size_t count = 0;
  for (int a = 0; a < kSamples; ++a) {
    for (int b = 0; b < kSamples; ++b)
      grey[count++] = grey_at(image, place((a + 0.5) / kSamples, (b + 0.5) / kSamples));
  }
  return median_of(grey.data(), grey.data() + count);
}

// A fraction of a length that leaves out `clear` of it at both ends.
double within(double clear, double fraction) { return clear + (1.0 - 2.0 * clear) * fraction; }

using SideLevels = std::array<double, kBlocksOfSide>;

// Levels over the sky along an edge, on the side where the pair is.
SideLevels levels_along(ImageView<const std::uint16_t> image, const EdgePair& pair, const Segment& edge, double sky) {
  const double inwards = edge.offset(pair.middle.middle()) > 0.0 ? 1.0 : -1.0;
  SideLevels levels{};
  for (int i = 0; i < kBlocksOfSide; ++i) {
    const double grey = level_of_block(image, [&](double along, double across) -> Vector2 {
      const double depth = kClearOfSides + (kSideBand - kClearOfSides) * across;
      return edge.begin + within(kClearOfEnds, (i + along) / kBlocksOfSide) * (edge.end - edge.begin) +
             inwards * depth * pair.separation * edge.across();
    });
    levels[static_cast<std::size_t>(i)] = grey - sky;
  }
  return levels;
}

// Whether nearly all of them are of one plane: within a fraction of its level.
bool are_of(const SideLevels& levels, double level, double max_departure) {
  return std::count_if(levels.begin(), levels.end(),
                       [&](double one) { return std::abs(one - level) < max_departure * level; }) >= kMinAlikeOfSide;
}

// Whether an edge borders the plane over all of its length, also where the other one has ended: a body's edge goes on
// along its next face.
bool borders_plane(ImageView<const std::uint16_t> image, const EdgePair& pair, const Segment& edge, double sky,
                   double level) {
  return are_of(levels_along(image, pair, edge, sky), level, kMaxDeparture);
}

}  // namespace

bool is_one_plane(ImageView<const std::uint16_t> image, const TargetMask& target, const EdgePair& pair) {
  if (pair.separation < kMinWidth_px) return false;
  const Strip strip(pair);
  std::array<double, kBlocks * kBlocks> levels{};
  std::size_t count = 0;
  for (int i = 0; i < kBlocks; ++i) {
    for (int k = 0; k < kBlocks; ++k) {
      const double grey = level_of_block(image, [&](double along, double across) {
        return strip.at(within(kClearOfEnds, (i + along) / kBlocks), within(kClearOfSides, (k + across) / kBlocks));
      });
      levels[count++] = grey - target.sky;
    }
  }
  const double level = median_of(levels.data(), levels.data() + count);
  const auto alike = std::count_if(levels.begin(), levels.end(),
                                   [&](double one) { return std::abs(one - level) < kMaxDeparture * level; });
  return static_cast<double>(alike) >= kMinAlike * static_cast<double>(count) &&
         borders_plane(image, pair, pair.first, target.sky, level) &&
         borders_plane(image, pair, pair.second, target.sky, level);
}

bool goes_on_along(ImageView<const std::uint16_t> image, const TargetMask& target, const EdgePair& pair,
                   const Segment& side, const Segment& gap) {
  SideLevels levels = levels_along(image, pair, side, target.sky);
  const double level = median_of(levels.data(), levels.data() + levels.size());
  return are_of(levels_along(image, pair, gap, target.sky), level, kMaxDepartureBeyond);
}

}  // namespace pharos::pointing
