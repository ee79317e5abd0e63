// SPDX-License-Identifier: Apache-2.0
// Section 3.1 of paper 003: binary image, line segments, the panel's edges.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "host/support/input_error.hpp"
#include "tools/pointing/paper/paper_line.hpp"

namespace pharos::tools::paper003 {
namespace {

constexpr double kFacing = 0.5;  // of the shorter edge: the part of it that must face the other

double slope_off(double a_rad, double b_rad) { return std::abs(std::remainder(a_rad - b_rad, std::numbers::pi)); }

// The slope with the largest sum of lengths around it.
double dominant_slope(const std::vector<LineSegment>& segments, double width_rad) {
  double best = 0.0, longest = -1.0;
  for (const LineSegment& one : segments) {
    double sum = 0.0;
    for (const LineSegment& other : segments) {
      if (slope_off(one.slope_rad(), other.slope_rad()) < width_rad) sum += other.length_px();
    }
    if (sum <= longest) continue;
    longest = sum;
    best = one.slope_rad();
  }
  return best;
}

LineSegment directed(const LineSegment& segment, const Vector2& along) {
  return along.dot(segment.end - segment.begin) < 0.0 ? LineSegment{segment.end, segment.begin} : segment;
}

// The part of two edges of one direction that lies side by side.
double facing_px(const LineSegment& a, const LineSegment& b) {
  const Vector2 along = (a.end - a.begin).normalized();
  const double low = std::max(0.0, along.dot(b.begin - a.begin));
  const double high = std::min(a.length_px(), along.dot(b.end - a.begin));
  return high - low;
}

// A segment that leads from one end point to the other.
std::optional<LineSegment> between(const std::vector<LineSegment>& segments, const Vector2& from, const Vector2& to,
                                   double max_gap_fraction) {
  constexpr double kCorner_px = 4.0;  // what LSD leaves out of an edge at a corner
  const double limit = kCorner_px + max_gap_fraction * (to - from).norm();
  for (const LineSegment& segment : segments) {
    const double same = std::max((segment.begin - from).norm(), (segment.end - to).norm());
    const double turned = std::max((segment.end - from).norm(), (segment.begin - to).norm());
    if (std::min(same, turned) < limit) return segment;
  }
  return std::nullopt;
}

// Two segments of the panel's slope that face each other, and the segments that close their ends.
struct FacingPair {
  std::array<LineSegment, 2> edges;
  std::vector<LineSegment> ends;

  double length_px() const { return std::min(edges[0].length_px(), edges[1].length_px()); }
  double score() const { return length_px() * (1.0 + static_cast<double>(ends.size())); }
};

std::vector<FacingPair> facing_pairs(const Stages& stages, const Constraints& constraints) {
  const double slope = constraints.slope_rad.value_or(dominant_slope(stages.kept, 0.5 * constraints.max_slope_off_rad));
  const Vector2 along(std::cos(slope), std::sin(slope));
  std::vector<LineSegment> candidates;
  for (const LineSegment& segment : stages.kept) {
    if (slope_off(segment.slope_rad(), slope) < constraints.max_slope_off_rad) {
      candidates.push_back(directed(segment, along));
    }
  }
  std::vector<FacingPair> pairs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (std::size_t j = i + 1; j < candidates.size(); ++j) {
      FacingPair pair{{candidates[i], candidates[j]}, {}};
      const auto& [a, b] = pair.edges;
      if (facing_px(a, b) < kFacing * pair.length_px()) continue;
      for (const auto& [from, to] : {std::pair{a.begin, b.begin}, {a.end, b.end}}) {
        const auto end = between(stages.segments, from, to, constraints.max_end_gap_fraction);
        if (end) pair.ends.push_back(*end);
      }
      pairs.push_back(pair);
    }
  }
  return pairs;
}

// The two ends that are farthest apart: of one panel, or of a wing's two, whose inner ends the body hides.
std::vector<LineSegment> outer_ends(const std::vector<FacingPair>& pairs, double min_length_px) {
  std::vector<LineSegment> ends, outer;
  for (const FacingPair& pair : pairs) {
    if (pair.length_px() >= min_length_px) ends.insert(ends.end(), pair.ends.begin(), pair.ends.end());
  }
  double farthest = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const double apart = 0.5 * (ends[i].begin + ends[i].end - ends[j].begin - ends[j].end).norm();
      if (apart <= std::max(farthest, 0.5 * min_length_px)) continue;
      farthest = apart;
      outer = {ends[i], ends[j]};
    }
  }
  return outer;
}

// By end points: the pair that is long and whose ends are closed.
void select(Stages& stages, const Constraints& constraints) {
  const std::vector<FacingPair> pairs = facing_pairs(stages, constraints);
  const auto best = std::max_element(pairs.begin(), pairs.end(),
                                     [](const FacingPair& a, const FacingPair& b) { return a.score() < b.score(); });
  if (best == pairs.end()) return;
  stages.found = true;
  stages.long_edges = best->edges;
  stages.short_edges = outer_ends(pairs, 0.5 * best->length_px());
}

}  // namespace

double LineSegment::slope_rad() const {
  const double angle = std::atan2(end.y() - begin.y(), end.x() - begin.x());
  return angle < 0.0 ? angle + std::numbers::pi : std::fmod(angle, std::numbers::pi);
}

Result<Stages, Failure> find_panel_edges(ImageView<const std::uint16_t> image, const Constraints& constraints) try {
  cv::Mat grey(image.height_px, image.width_px, CV_8U);
  for (std::int32_t v = 0; v < image.height_px; ++v) {
    const std::uint16_t* from = image.row(v);
    std::transform(from, from + image.width_px, grey.ptr(v), [](std::uint16_t value) { return value >> 8U; });
  }
  double low = 0.0, high = 0.0;
  cv::minMaxLoc(grey, &low, &high);
  if (low == high) return Failure::kNoContrast;
  Stages stages;
  cv::Mat binary;
  stages.threshold = static_cast<int>(cv::threshold(grey, binary, 0.0, 255.0, cv::THRESH_BINARY | cv::THRESH_OTSU));
  stages.binary.assign(binary.datastart, binary.dataend);
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(binary, found);
  double longest = 0.0;
  for (const cv::Vec4d line : found) {
    stages.segments.push_back({{line[0], line[1]}, {line[2], line[3]}});
    longest = std::max(longest, stages.segments.back().length_px());
  }
  std::copy_if(
      stages.segments.begin(), stages.segments.end(), std::back_inserter(stages.kept),
      [&](const LineSegment& segment) { return segment.length_px() >= constraints.min_length_fraction * longest; });
  select(stages, constraints);
  return stages;
} catch (const cv::Exception& error) {
  throw host::InputError(std::string("OpenCV failed on the image: ") + error.what());
}

}  // namespace pharos::tools::paper003
