// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pharos::pointing {
namespace {

// Of a pixel's noise, what the median of an edge's dark levels may be off: many times its own deviation.
constexpr double kHalfNoise = 0.5;
constexpr double kDarkSigmas = 2.7;  // of blur: from here on a Gaussian rise adds less than 0.4 % of its height
constexpr double kBehind_px = 6.0;   // beyond a profile's reach: wider than the side of a panel
constexpr double kMedianToSigma = 1.4826;
constexpr double kMinScatter = 0.3;  // of a pixel's noise, of a profile's mean beyond the rise
// 2 sqrt(pi): of a Gaussian rise of unit contrast, blur over the integral of the squared slope.
constexpr double kShiftOfExcess = 3.5449077;

// The dark side's level, by the pixels that the rise does not reach. The fitted level also depends on what stands
// beside the edge on its bright side: a panel's frame moved it by 1.7 % of the contrast.
double dark_beyond(const Profile& profile, const Rise& rise, double blur) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < profile.size; ++i) {
    if (profile.position[i] > rise.place - kDarkSigmas * blur) continue;
    sum += profile.value[i];
    ++count;
  }
  return count == 0 ? rise.dark : sum / count;
}

// The mean level of the pixels that lie farther out than a profile reaches.
std::optional<double> level_behind(const Profile& wide, const Rise& rise, double reach_px) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < wide.size; ++i) {
    if (wide.position[i] > rise.place - reach_px) continue;
    sum += wide.value[i];
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

// Mean of an edge's levels, stars and what else stands out of them left out. A median would be that of whole counts.
std::optional<Backdrop> backdrop_of(const std::vector<double>& levels, double noise) {
  if (levels.empty()) return std::nullopt;
  const double middle = median(levels);
  std::vector<double> deviations;
  for (const double level : levels) deviations.push_back(std::abs(level - middle));
  const double scatter = std::max(kMedianToSigma * median(deviations), kMinScatter * noise);
  double sum = 0.0, count = 0.0;
  for (const double level : levels) {
    if (std::abs(level - middle) > kOutlierSigmas * scatter) continue;
    sum += level;
    count += 1.0;
  }
  return Backdrop{sum / count, scatter / std::sqrt(count)};
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void ProfileStack::add(const Profile& profile, const Rise& rise, double blur) {
  const double contrast = rise.bright - rise.dark;
  for (std::size_t i = 0; i < profile.size; ++i) {
    const double across = profile.position[i] - rise.place;
    const double fitted = rise.dark + contrast * rise_fraction(across / blur);
    const auto bin = static_cast<std::size_t>(std::clamp((across + kHalf_px) / kBin_px, 0.0, kBins - 1.0));
    const double residual = (profile.value[i] - fitted) / contrast;
    sum_[bin] += residual;
    squares_[bin] += residual * residual;
    ++count_[bin];
  }
}

double ProfileStack::excess_px() const {
  double sum = 0.0, noise = 0.0;
  for (std::size_t i = 0; i < kBins; ++i) {
    if (count_[i] < kMinInBin) continue;
    const double n = count_[i], mean = sum_[i] / n;
    const double variance = std::max(0.0, squares_[i] / n - mean * mean) / (n - 1.0);
    sum += mean * mean - variance;
    noise += 2.0 * variance * variance;  // of the square of a normal number
  }
  return kBin_px * std::max(0.0, sum - kNoiseSigmas * std::sqrt(noise));
}

void EdgeSurroundings::add(const EdgeSample& one, bool is_second_half) {
  contrasts_.push_back(one.contrast);
  if (const auto profile = scan_.profile(one.index, settings_.reach_px)) {
    halves_[is_second_half ? 1 : 0].add(*profile, one.rise, settings_.blur);
    darks_.push_back(dark_beyond(*profile, one.rise, settings_.blur));
  }
  if (const auto wide = scan_.profile(one.index, settings_.reach_px + kBehind_px)) {
    if (const auto level = level_behind(*wide, one.rise, settings_.reach_px)) behind_.push_back(*level);
  }
}

void EdgeSurroundings::state(const TargetMask& target, MeasuredEdge& edge) const {
  const double excess_px = std::max(halves_[0].excess_px(), halves_[1].excess_px());
  edge.structure_px = std::sqrt(kShiftOfExcess * settings_.blur * excess_px);
  if (darks_.empty()) return;
  edge.contrast = median(contrasts_);
  edge.backdrop = backdrop_of(behind_, target.noise);
  edge.backing = (median(darks_) - target.sky - kHalfNoise * target.noise) / edge.contrast;
}

}  // namespace pharos::pointing
