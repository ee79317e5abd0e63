// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/outline.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr double kMaxTurn = 0.05;          // rad between segments of one edge
constexpr double kMaxOutlineOff_px = 1.6;  // of a segment's ends from the edge that it continues
constexpr double kOffPerLength = 0.004;    // and for every pixel of distance: accuracy of LSD's ends
constexpr double kMaxGap_px = 10.0;
constexpr double kMaxGapFraction = 0.1;  // the body between a wing's panels is more
constexpr double kMinLength_px = 6.0;
constexpr double kBeside_px = 3.0;  // distance at which the two sides of an edge are sampled
constexpr int kLooks = 7;

// The image clipped around Otsu's threshold, with the grey steps of its edges, from which LSD computes directions.
// Twice the threshold's height over the sky is white, so that there are no edges inside the target.
std::vector<std::uint8_t> clipped(ImageView<const std::uint16_t> image, const TargetMask& target) {
  const Box& box = target.box;
  const double scale = 127.5 / std::max(1.0, target.threshold - target.sky);
  std::vector<std::uint8_t> grey(target.mask.size());
  std::uint8_t* out = grey.data();
  for (std::int32_t v = box.top; v < box.top + box.height; ++v) {
    const std::uint16_t* row = image.row(v) + box.left;
    for (std::int32_t u = 0; u < box.width; ++u) {
      *out++ = static_cast<std::uint8_t>(std::clamp(scale * (row[u] - target.sky), 0.0, 255.0));
    }
  }
  return grey;
}

// Target's fraction on the positive side minus that on the other: -1 to 1.
double side_of_target(const TargetMask& target, const Segment& segment) {
  const Vector2 step = kBeside_px * segment.across();
  int more = 0;
  for (int k = 0; k < kLooks; ++k) {
    const Vector2 place = segment.begin + (k + 0.5) / kLooks * (segment.end - segment.begin);
    const auto inside = [&](const Vector2& at) {
      return target.at(static_cast<std::int32_t>(std::lround(at.x())), static_cast<std::int32_t>(std::lround(at.y())))
                 ? 1
                 : 0;
    };
    more += inside(place + step) - inside(place - step);
  }
  return static_cast<double>(more) / kLooks;
}

bool continues(const Segment& edge, const Segment& segment) {
  if (edge.along().dot(segment.along()) < std::cos(kMaxTurn)) return false;
  const double first = edge.station(segment.begin), last = edge.station(segment.end), length = edge.length();
  const double gap = std::max({0.0, first - length, -last});
  if (gap > std::max(kMaxGap_px, kMaxGapFraction * (length + segment.length()))) return false;
  const double away = std::max({0.0, last - length, -first});
  const double maximum = kMaxOutlineOff_px + kOffPerLength * away;
  return std::abs(edge.offset(segment.begin)) < maximum && std::abs(edge.offset(segment.end)) < maximum;
}

Segment with(const Segment& edge, const Segment& segment) {
  Segment longer = edge;
  if (edge.station(segment.begin) < 0.0) longer.begin = segment.begin;
  if (edge.station(segment.end) > edge.length()) longer.end = segment.end;
  return longer;
}

void sort_by_length(std::vector<Segment>& segments) {
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.length() > b.length(); });
}

}  // namespace

std::vector<Segment> joined(std::vector<Segment> segments) {
  bool again = true;
  while (again) {
    again = false;
    sort_by_length(segments);
    for (std::size_t i = 0; i < segments.size(); ++i) {
      for (std::size_t k = segments.size(); k-- > i + 1;) {
        if (!continues(segments[i], segments[k])) continue;
        segments[i] = with(segments[i], segments[k]);
        segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(k));
        again = true;
      }
    }
  }
  return segments;
}

std::vector<Segment> outline_edges(ImageView<const std::uint16_t> image, const TargetMask& target) {
  const std::vector<std::uint8_t> grey = clipped(image, target);
  std::vector<Segment> edges;
  const Vector2 corner(target.box.left, target.box.top);
  for (Segment segment : find_segments({grey.data(), target.box.width, target.box.height})) {
    segment.begin += corner;
    segment.end += corner;
    if (segment.length() < kMinLength_px) continue;
    const double side = side_of_target(target, segment);
    if (std::abs(side) < 0.5) continue;
    if (side < 0.0) std::swap(segment.begin, segment.end);
    edges.push_back(segment);
  }
  return joined(std::move(edges));
}

}  // namespace pharos::pointing
