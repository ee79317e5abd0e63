// SPDX-License-Identifier: Apache-2.0
#include "host/clock/lower_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pharos::host {
namespace {

constexpr double kBin_s = 0.5;
/// Long enough for 0.1 ms of jitter to become 2 ppm of drift, short enough to follow a crystal whose temperature
/// changes.
constexpr std::int64_t kWindowBins = 120;
/// Below this span the drift is not estimated but zero: the slope of two bins is arbitrary.
constexpr double kMinSpan_s = 2.0;
/// Relative drift of two crystals of 100 ppm each.
constexpr double kLargestDrift_ns_per_s = 200e3;

/// A smallest delay is an outlier if its distance to the second smallest of its bin is more than so many times the
/// typical one: exponential gaps reach that in 1 of 250 bins, where using the second costs almost nothing.
constexpr double kCredibleGaps = 8.0;
/// Fewer bins do not give a typical distance: there every smallest delay counts as an outlier.
constexpr std::size_t kBinsForGap = 3;

/// Median of at least one value; reorders them.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Slope of the lower hull's edge over the mean time. `points` by time.
template <class Points>
double hull_drift(const Points& points) {
  Points hull;
  double mean_s = 0.0;
  for (const auto& point : points) {
    mean_s += point.time_s / static_cast<double>(points.size());
    const auto turns_down = [&] {
      const auto& a = hull[hull.size() - 2];
      const auto& b = hull.back();
      return (b.delay_ns - a.delay_ns) * (point.time_s - a.time_s) >=
             (point.delay_ns - a.delay_ns) * (b.time_s - a.time_s);
    };
    while (hull.size() >= 2 && turns_down()) hull.pop_back();
    hull.push_back(point);
  }
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].time_s < mean_s) continue;
    return (hull[i].delay_ns - hull[i - 1].delay_ns) / (hull[i].time_s - hull[i - 1].time_s);
  }
  return 0.0;
}

}  // namespace

void LowerEnvelope::add(double time_s, double delay_ns) {
  const auto number = static_cast<std::int64_t>(std::floor(time_s / kBin_s));
  auto bin = bins_.end();
  while (bin != bins_.begin() && std::prev(bin)->number >= number) --bin;
  const Point point{time_s, delay_ns};
  if (bin == bins_.end() || bin->number != number) {
    bins_.insert(bin, {number, point, std::nullopt});
  } else if (delay_ns < bin->minimum.delay_ns) {
    bin->second = bin->minimum;
    bin->minimum = point;
  } else if (!bin->second || delay_ns < bin->second->delay_ns) {
    bin->second = point;
  } else {
    return;
  }
  line_.reset();
  while (bins_.front().number <= bins_.back().number - kWindowBins) bins_.pop_front();
}

std::vector<LowerEnvelope::Point> LowerEnvelope::points() const {
  std::vector<Point> points;
  std::vector<double> gaps;
  for (const Bin& bin : bins_) {
    if (bin.second) gaps.push_back(bin.second->delay_ns - bin.minimum.delay_ns);
  }
  const double credible_gap_ns = gaps.size() < kBinsForGap ? 0.0 : kCredibleGaps * median(gaps);
  for (const Bin& bin : bins_) {
    if (!bin.second && !gaps.empty()) continue;
    const bool alone = bin.second && bin.second->delay_ns - bin.minimum.delay_ns > credible_gap_ns;
    points.push_back(alone ? *bin.second : bin.minimum);
  }
  return points;
}

const std::optional<LowerEnvelope::Line>& LowerEnvelope::fit() {
  if (!line_) line_ = fitted();
  return line_;
}

std::optional<LowerEnvelope::Line> LowerEnvelope::fitted() const {
  const std::vector<Point> all = points();
  if (all.empty()) return std::nullopt;
  Line line;
  line.at_s = all.back().time_s;
  line.span_s = line.at_s - all.front().time_s;
  if (line.span_s >= kMinSpan_s) {
    line.drift_ns_per_s = std::clamp(hull_drift(all), -kLargestDrift_ns_per_s, kLargestDrift_ns_per_s);
  }
  line.delay_ns = std::numeric_limits<double>::max();
  for (const Point& point : all) {
    line.delay_ns = std::min(line.delay_ns, point.delay_ns - line.drift_ns_per_s * (point.time_s - line.at_s));
  }
  std::vector<double> heights;
  for (const Point& point : all) heights.push_back(point.delay_ns - line.value(point.time_s));
  line.scatter_ns = median(heights);
  return line;
}

}  // namespace pharos::host
