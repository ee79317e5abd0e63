// SPDX-License-Identifier: Apache-2.0
#include "host/clock/lower_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pharos::host {
namespace {

constexpr double kBinS = 0.5;
/// Long enough for 0.1 ms of jitter to become 2 ppm of drift, short enough to follow a crystal that warms up.
constexpr std::int64_t kWindowBins = 120;
/// Below this span the drift is not measured but taken as zero: two bins make any slope.
constexpr double kLeastSpanS = 2.0;
/// Two crystals of 100 ppm each.
constexpr double kLargestDriftNsPerS = 200e3;

}  // namespace

void LowerEnvelope::add(double time_s, double delay_ns) {
  const auto number = static_cast<std::int64_t>(std::floor(time_s / kBinS));
  auto bin = bins_.end();
  while (bin != bins_.begin() && std::prev(bin)->number >= number) --bin;
  if (bin == bins_.end() || bin->number != number) {
    bins_.insert(bin, {number, time_s, delay_ns});
  } else if (delay_ns < bin->delay_ns) {
    *bin = {number, time_s, delay_ns};
  }
  while (bins_.front().number <= bins_.back().number - kWindowBins) bins_.pop_front();
}

double LowerEnvelope::hull_drift() const {
  std::vector<Bin> hull;
  double mean_s = 0.0;
  for (const Bin& bin : bins_) {
    mean_s += bin.time_s / static_cast<double>(bins_.size());
    const auto turns_down = [&] {
      const Bin& a = hull[hull.size() - 2];
      const Bin& b = hull.back();
      return (b.delay_ns - a.delay_ns) * (bin.time_s - a.time_s) >= (bin.delay_ns - a.delay_ns) * (b.time_s - a.time_s);
    };
    while (hull.size() >= 2 && turns_down()) hull.pop_back();
    hull.push_back(bin);
  }
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].time_s < mean_s) continue;
    return (hull[i].delay_ns - hull[i - 1].delay_ns) / (hull[i].time_s - hull[i - 1].time_s);
  }
  return 0.0;
}

std::optional<LowerEnvelope::Line> LowerEnvelope::fit() const {
  if (bins_.empty()) return std::nullopt;
  Line line;
  line.at_s = bins_.back().time_s;
  line.span_s = line.at_s - bins_.front().time_s;
  if (line.span_s >= kLeastSpanS) {
    line.drift_ns_per_s = std::clamp(hull_drift(), -kLargestDriftNsPerS, kLargestDriftNsPerS);
  }
  line.delay_ns = std::numeric_limits<double>::max();
  for (const Bin& bin : bins_) {
    line.delay_ns = std::min(line.delay_ns, bin.delay_ns - line.drift_ns_per_s * (bin.time_s - line.at_s));
  }
  std::vector<double> heights;
  for (const Bin& bin : bins_) heights.push_back(bin.delay_ns - line.value(bin.time_s));
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  line.scatter_ns = *middle;
  return line;
}

}  // namespace pharos::host
