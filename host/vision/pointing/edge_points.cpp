// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/vision/pointing/edge_scan.hpp"
#include "host/vision/pointing/edge_surroundings.hpp"

namespace pharos::pointing {
namespace {

// Half length of a profile, sigmas of blur. Shorter ones (2.5) end before a panel's cells and are better at 100 m, but
// from 1 km on the errors of their axes are 1.5 times the stated ones.
constexpr double kReachSigmas = 4.0;
constexpr double kMinReach_px = 3.5;
constexpr double kMaxReach_px = 14.0;
constexpr double kMinBlur_px = 0.35;
constexpr double kMaxBlur_px = 4.0;
constexpr double kMaxOffLine_px = 0.8;  // from the edge's own line: farther points are of another edge
// Of the rows that an edge crosses: of 492 sides of 150 random satellites two have less than a half, 0.06 and 0.22.
constexpr double kMinOfRows = 0.35;
constexpr double kMinShortSigmas = 2.5;  // of blur, that a short profile must reach
constexpr double kCornerSigmas = 3.0;
constexpr double kBorder_px = 3.0;

// The blur that fits a few dozen of the edge's profiles best, by golden section.
double blur_of(const EdgeScan& scan, const std::vector<EdgeSample>& samples, double reach_px) {
  const std::size_t stride = std::max<std::size_t>(1, samples.size() / 30);
  const auto misfit = [&](double blur) {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      const auto profile = scan.profile(samples[i].index, reach_px);
      const auto rise = profile ? fit_rise(*profile, blur, samples[i].across) : std::nullopt;
      if (rise) sum += rise->residual / (samples[i].contrast * samples[i].contrast);
    }
    return sum;
  };
  constexpr double kGolden = 0.6180339887498949;
  double low = kMinBlur_px, high = std::min(kMaxBlur_px, 0.6 * reach_px);
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low), at_a = misfit(a), at_b = misfit(b);
  while (high - low > 0.02) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = misfit(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = misfit(b);
    }
  }
  return 0.5 * (low + high);
}

std::optional<Segment> line_through(const EdgeScan& scan, const std::vector<EdgeSample>& samples,
                                    const Segment& guess) {
  std::vector<EdgePoint> points;
  points.reserve(samples.size());
  for (const EdgeSample& one : samples) points.push_back({scan.place(one.index, one.across), 1.0});
  const auto fit = fit_line(points);
  if (!fit) return std::nullopt;
  Segment line{fit->begin_px, fit->end_px};
  if (line.along().dot(guess.along()) < 0.0) std::swap(line.begin, line.end);
  return line;
}

bool near_border(ImageView<const std::uint16_t> image, const Vector2& place, double reach) {
  return place.x() < reach || place.y() < reach || place.x() > image.width_px - 1 - reach ||
         place.y() > image.height_px - 1 - reach;
}

double reach_for(double blur, double maximum) {
  return std::min(std::clamp(kReachSigmas * blur, kMinReach_px, kMaxReach_px), std::max(2.5, maximum));
}

// The line through an edge's rises with its own blur and contrast: along the guess, then again along the fitted line.
// Empty where there is no edge.
std::optional<Segment> settled_line(ImageView<const std::uint16_t> image, const TargetMask& target,
                                    const Segment& guess, double reach_px, ScanSettings& settings) {
  Segment line = guess;
  for (int round = 0; round < 2; ++round) {
    const EdgeScan scan(image, line);
    const std::vector<EdgeSample> samples =
        samples_between(scan, target, scan.index_at(0.0), scan.index_at(line.length()), settings);
    if (samples.size() < kMinEdgePoints) return std::nullopt;
    std::vector<double> contrasts;
    for (const EdgeSample& one : samples) contrasts.push_back(one.contrast);
    settings.contrast = median(contrasts);
    settings.blur = blur_of(scan, samples, settings.reach_px);
    settings.reach_px = reach_for(settings.blur, reach_px);
    const auto better = line_through(scan, samples, guess);
    if (!better) return std::nullopt;
    line = *better;
  }
  return line;
}

// By profiles of at most this reach, whatever comes of it.
MeasuredEdge edge_within(ImageView<const std::uint16_t> image, const TargetMask& target, const Segment& guess,
                         double reach_px) {
  MeasuredEdge edge;
  edge.extent = guess;
  ScanSettings settings;
  settings.reach_px = std::min(settings.reach_px, std::max(2.5, reach_px));
  const auto line = settled_line(image, target, guess, reach_px, settings);
  if (!line) return edge;
  settings.max_off_px = kMaxOffLine_px;
  const EdgeScan scan(image, *line);
  const int step = scan.direction();
  const int first = followed(scan, target, scan.index_at(0.0), -step, settings);
  const int last = followed(scan, target, scan.index_at(line->length()), step, settings);
  edge.extent = {scan.crossing(first), scan.crossing(last)};
  edge.blur_px = settings.blur;
  edge.cut = near_border(image, edge.extent.begin, kBorder_px + 1.5 * settings.reach_px) ||
             near_border(image, edge.extent.end, kBorder_px + 1.5 * settings.reach_px);
  edge.corner_px = kCornerSigmas * settings.blur + 1.0;
  const auto is_corner = [&](const Vector2& place) {
    return (place - edge.extent.begin).norm() < edge.corner_px || (place - edge.extent.end).norm() < edge.corner_px;
  };
  EdgeSurroundings surroundings(scan, settings);
  for (const EdgeSample& one : samples_between(scan, target, first, last, settings)) {
    const Vector2 place = scan.place(one.index, one.across);
    if (is_corner(place)) continue;
    edge.points.push_back({place, 1.0});
    surroundings.add(one, 2 * std::abs(one.index - first) > std::abs(last - first));
  }
  surroundings.state(target, edge);
  return edge;
}

// Whether the rows or columns that an edge crosses have a rise near its line. Where few have, no such rise is there,
// and what is left are a wrong fit's tails.
bool is_of_its_rows(const MeasuredEdge& edge) {
  const Vector2 d = edge.extent.end - edge.extent.begin;
  const double rows = d.cwiseAbs().maxCoeff() * std::max(0.0, 1.0 - 2.0 * edge.corner_px / d.norm());
  return static_cast<double>(edge.points.size()) > kMinOfRows * rows;
}

}  // namespace

MeasuredEdge measure_edge(ImageView<const std::uint16_t> image, const TargetMask& target, const Segment& guess,
                          double reach_px) {
  MeasuredEdge edge = edge_within(image, target, guess, reach_px);
  if (edge.points.empty() || is_of_its_rows(edge)) return edge;
  // Where a bright line runs beside an edge, a wide rise up to it fits long profiles best; short ones end before it.
  const double short_px = std::min(reach_px, kMinReach_px);
  const bool cut = edge.cut;
  edge = edge_within(image, target, guess, short_px);
  edge.cut = edge.cut || cut;
  if (kMinShortSigmas * edge.blur_px > short_px || !is_of_its_rows(edge)) edge.points.clear();
  return edge;
}

}  // namespace pharos::pointing
