// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/time_offset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pharos::evaluate {
namespace {

constexpr double kMinStep_s = 0.005;
constexpr double kMaxSamples = 8192.0;    // 0.1 s of work
constexpr double kSpeedBaseline_s = 0.2;  // noise of 0.1 deg is then 0.7 deg/s
constexpr double kGapIntervals = 10.0;    // a lost cycle or two hardly changes the speed over the baseline
constexpr double kClipQuantile = 0.98;    // wrong minima are spikes
constexpr double kMinCorrelation = 0.6;
constexpr double kSecondPeakFraction = 0.95;
constexpr double kMinOverlap = 0.5;
constexpr std::size_t kMinSamples = 20;

/// Speeds at equal steps; nan where there is none.
struct Profile {
  double start_s = 0.0;
  std::vector<double> values;
};

struct Profiles {
  Profile turning;
  Profile moving;
};

void clip(std::vector<double>& values) {
  std::vector<double> known;
  std::copy_if(values.begin(), values.end(), std::back_inserter(known), [](double v) { return std::isfinite(v); });
  if (known.empty()) return;
  const auto at = known.begin() + static_cast<std::ptrdiff_t>(kClipQuantile * static_cast<double>(known.size() - 1));
  std::nth_element(known.begin(), at, known.end());
  for (double& value : values) {
    if (value > *at) value = *at;
  }
}

template <class WorldFromBody>
Profiles profiles_of(const Trajectory<WorldFromBody>& trajectory, double step_s) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double half_s = 0.5 * std::max(kSpeedBaseline_s, 2.0 * step_s);
  const double gap_s = std::max(kGapIntervals * median_interval_s(trajectory), 2.0 * step_s);
  Profiles profiles;
  profiles.turning.start_s = profiles.moving.start_s = trajectory.front().time_s;
  const auto count = static_cast<std::size_t>((trajectory.back().time_s - trajectory.front().time_s) / step_s) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = trajectory.front().time_s + static_cast<double>(i) * step_s;
    const auto a = pose_at(trajectory, time_s - half_s, gap_s);
    const auto b = pose_at(trajectory, time_s + half_s, gap_s);
    const bool known = a && b;
    profiles.turning.values.push_back(known ? rotation_angle_between(a->pose.R, b->pose.R) / (2.0 * half_s) : kNone);
    profiles.moving.values.push_back(known ? (b->pose.t - a->pose.t).norm() / (2.0 * half_s) : kNone);
  }
  clip(profiles.turning.values);
  clip(profiles.moving.values);
  return profiles;
}

/// Normalised correlation of a[i] with b[i + lag] where both exist; -1 where there are too few.
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t lag,
                   std::size_t minimum) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, -lag);
  const auto end = std::min(std::ssize(a), std::ssize(b) - lag);
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double x = a[static_cast<std::size_t>(i)];
    const double y = b[static_cast<std::size_t>(i + lag)];
    if (!std::isfinite(x + y)) continue;
    n += 1, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  if (n < static_cast<double>(minimum)) return -1.0;
  const double spread = (saa - sa * sa / n) * (sbb - sb * sb / n);
  const double scale = saa * sbb;
  return spread > 1e-12 * scale ? (sab - sa * sb / n) / std::sqrt(spread) : -1.0;
}

struct Peak {
  double correlation = -1.0;
  double second_peak = -1.0;  // largest correlation outside of the main peak
  std::ptrdiff_t lag = 0;
};

std::size_t known(const std::vector<double>& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](double v) { return std::isfinite(v); }));
}

Peak best_lag(const std::vector<double>& a, const std::vector<double>& b) {
  const auto fraction = static_cast<std::size_t>(kMinOverlap * static_cast<double>(std::min(known(a), known(b))));
  const std::size_t minimum = std::max(kMinSamples, fraction);
  const std::ptrdiff_t first = -std::ssize(a);
  std::vector<double> all;
  for (std::ptrdiff_t lag = first; lag <= std::ssize(b); ++lag) all.push_back(correlation(a, b, lag, minimum));
  const auto top = std::max_element(all.begin(), all.end());
  Peak peak{*top, -1.0, first + (top - all.begin())};
  // Down to the minima on both sides of the peak; the second peak is beyond them.
  auto right = top;
  while (right != all.end() && *right > 0.5 * *top) ++right;
  auto left = top;
  while (left != all.begin() && *left > 0.5 * *top) --left;
  if (right != all.end()) peak.second_peak = *std::max_element(right, all.end());
  if (left != all.begin()) peak.second_peak = std::max(peak.second_peak, *std::max_element(all.begin(), left));
  return peak;
}

}  // namespace

CoarseOffset coarse_time_offset(const Trajectory<EstimatePose>& estimate, const Trajectory<TruthPose>& truth) {
  if (estimate.size() < 2 || truth.size() < 2) return {{}, "fewer than two poses on one side", 0.0};
  const double longest_s =
      std::max(estimate.back().time_s - estimate.front().time_s, truth.back().time_s - truth.front().time_s);
  const double step_s = std::max(kMinStep_s, longest_s / kMaxSamples);
  const Profiles e = profiles_of(estimate, step_s);
  const Profiles t = profiles_of(truth, step_s);
  const Peak turning = best_lag(e.turning.values, t.turning.values);
  const Peak moving = best_lag(e.moving.values, t.moving.values);
  const Peak& best = turning.correlation >= moving.correlation ? turning : moving;
  CoarseOffset result{{}, "", best.correlation};
  if (best.correlation < kMinCorrelation) {
    result.why = "the two neither turn nor move alike at any offset (correlation " +
                 std::to_string(std::max(best.correlation, 0.0)) + ")";
  } else if (best.second_peak > kSecondPeakFraction * best.correlation) {
    result.why = "the motion repeats itself, several offsets fit alike";
  } else {
    result.offset_s = truth.front().time_s + static_cast<double>(best.lag) * step_s - estimate.front().time_s;
  }
  return result;
}

}  // namespace pharos::evaluate
