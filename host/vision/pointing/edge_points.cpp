// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "host/vision/pointing/rise_fit.hpp"

namespace pharos::pointing {
namespace {

// Half length of a profile, sigmas of blur. Shorter ones (2.5) end before a panel's cells and are better at 100 m, but
// from 1 km on the errors of their axes are 1.5 times the stated ones.
constexpr double kReachSigmas = 4.0;
constexpr double kMinReach_px = 3.5;
constexpr double kMaxReach_px = 14.0;
constexpr double kFirstBlur_px = 1.2;
constexpr double kMinBlur_px = 0.35;
constexpr double kMaxBlur_px = 4.0;
constexpr double kMaxOff_px = 2.5;      // from LSD's guess
constexpr double kMaxOffLine_px = 0.8;  // from the edge's own line: farther points are of another edge
constexpr double kMinContrast = 0.5;    // of the edge's median
constexpr double kMaxContrast = 1.6;
constexpr double kDarkness = 0.25;  // of the contrast: tolerance for the dark side to be sky
constexpr int kMaxMisses = 3;       // in a row: an edge ends there
// Of a pixel's noise, what the median of an edge's dark levels may be off: many times its own deviation.
constexpr double kHalfNoise = 0.5;
constexpr double kCornerSigmas = 3.0;
constexpr double kDarkSigmas = 2.7;  // of blur: from here on a Gaussian rise adds less than 0.4 % of its height
constexpr double kBehind_px = 6.0;   // beyond a profile's reach: wider than the side of a panel
constexpr double kMedianToSigma = 1.4826;
constexpr double kMinScatter = 0.3;  // of a pixel's noise, of a profile's mean beyond the rise
constexpr double kBorder_px = 3.0;
// 2 sqrt(pi): of a Gaussian rise of unit contrast, blur over the integral of the squared slope.
constexpr double kShiftOfExcess = 3.5449077;

// The mean of an edge's profiles about their own positions, less the rise that was fitted to each: what stands beside
// the edge the same way all along it.
class ProfileStack {
 public:
  void add(const Profile& profile, const Rise& rise, double blur) {
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

  /// Integral of the square of the mean residual beyond what the profiles' scatter explains, px of unit contrast.
  double excess_px() const {
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

 private:
  static constexpr std::size_t kBins = 128;
  static constexpr double kHalf_px = 16.0, kBin_px = 0.25;
  static constexpr int kMinInBin = 8;
  static constexpr double kNoiseSigmas = 2.0;
  std::array<double, kBins> sum_{}, squares_{};
  std::array<int, kBins> count_{};
};

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

// Steps along the line by one row or column, whichever is closer to perpendicular.
class EdgeScan {
 public:
  EdgeScan(ImageView<const std::uint16_t> image, const Segment& line) : image_(image), line_(line) {
    const Vector2 across = line.across();
    along_rows_ = std::abs(across.x()) >= std::abs(across.y());  // the profile is part of a row
    slope_ = along_rows_ ? across.x() : across.y();
    const Vector2 d = line.along();
    step_ = along_rows_ ? d.y() : d.x();
  }

  /// Index of the row or column at a station along the line.
  int index_at(double station) const {
    const Vector2 place = line_.begin + station * line_.along();
    return static_cast<int>(std::lround(along_rows_ ? place.y() : place.x()));
  }
  int direction() const { return step_ > 0.0 ? 1 : -1; }

  // Where the line crosses the row or column.
  Vector2 crossing(int index) const {
    const Vector2 d = line_.along();
    const double from = along_rows_ ? line_.begin.y() : line_.begin.x();
    return line_.begin + (index - from) / step_ * d;
  }

  std::optional<Profile> profile(int index, double reach_px) const {
    const Vector2 middle = crossing(index);
    const double centre = along_rows_ ? middle.x() : middle.y(), half = reach_px / std::abs(slope_);
    const int low = static_cast<int>(std::ceil(centre - half)), high = static_cast<int>(std::floor(centre + half));
    const int across_limit = along_rows_ ? image_.width_px : image_.height_px;
    const int along_limit = along_rows_ ? image_.height_px : image_.width_px;
    if (low < 0 || high >= across_limit || index < 0 || index >= along_limit) return std::nullopt;
    Profile result;
    for (int i = low; i <= high && result.size < result.position.size(); ++i) {
      result.position[result.size] = (i - centre) * slope_;
      result.value[result.size] = along_rows_ ? image_.at(i, index) : image_.at(index, i);
      ++result.size;
    }
    return result;
  }

  /// The pixel position of a rise at `across` px from the line in this row or column.
  Vector2 place(int index, double across) const {
    Vector2 result = crossing(index);
    (along_rows_ ? result.x() : result.y()) += across / slope_;
    return result;
  }

 private:
  ImageView<const std::uint16_t> image_;
  Segment line_;
  bool along_rows_ = false;
  double slope_ = 1.0;  // distance across the edge from a pixel of a profile to the next
  double step_ = 1.0;
};

struct Sample {
  int index = 0;
  double across = 0.0;
  double contrast = 0.0;
  double dark = 0.0;
  Rise rise;
};

// Properties of a valid point of this edge.
struct ScanSettings {
  double blur = kFirstBlur_px;
  double contrast = 0.0;  // 0: not known yet
  double reach_px = 6.0;
  double max_off_px = kMaxOff_px;
};

std::optional<Sample> sample(const EdgeScan& scan, const TargetMask& target, int index, const ScanSettings& settings) {
  const auto profile = scan.profile(index, settings.reach_px);
  if (!profile || profile->size < 5) return std::nullopt;
  const auto rise = fit_rise(*profile, settings.blur, 0.0);
  if (!rise || std::abs(rise->place) > std::min(settings.max_off_px, settings.reach_px - 1.0)) return std::nullopt;
  const double contrast = rise->bright - rise->dark;
  const double minimum =
      settings.contrast > 0.0 ? kMinContrast * settings.contrast : 0.5 * (target.threshold - target.sky);
  if (settings.contrast > 0.0 && contrast > kMaxContrast * settings.contrast) return std::nullopt;
  if (contrast < minimum || std::abs(rise->dark - target.sky) > kDarkness * contrast + 3.0 * target.noise) {
    return std::nullopt;
  }
  return Sample{index, rise->place, contrast, rise->dark, *rise};
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
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

// The blur that fits a few dozen of the edge's profiles best, by golden section.
double blur_of(const EdgeScan& scan, const std::vector<Sample>& samples, double reach_px) {
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

std::vector<Sample> samples_between(const EdgeScan& scan, const TargetMask& target, int from, int to,
                                    const ScanSettings& settings, int every = 1) {
  std::vector<Sample> samples;
  const int step = scan.direction();
  for (int index = from; step * (to - index) >= 0; index += every * step) {
    if (const auto one = sample(scan, target, index, settings)) samples.push_back(*one);
  }
  return samples;
}

// From `index` on in steps of `step` until the edge ends; the index of the last good one.
int followed(const EdgeScan& scan, const TargetMask& target, int index, int step, const ScanSettings& settings) {
  int last = index, misses = 0;
  for (int next = index + step; misses < kMaxMisses; next += step) {
    if (sample(scan, target, next, settings)) {
      last = next;
      misses = 0;
    } else {
      ++misses;
    }
  }
  return last;
}

std::optional<Segment> line_through(const EdgeScan& scan, const std::vector<Sample>& samples, const Segment& guess) {
  std::vector<pointing::EdgePoint> points;
  points.reserve(samples.size());
  for (const Sample& one : samples) points.push_back({scan.place(one.index, one.across), 1.0});
  const auto fit = pointing::fit_line(points);
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

}  // namespace

MeasuredEdge measure_edge(ImageView<const std::uint16_t> image, const TargetMask& target, const Segment& guess,
                          double reach_px) {
  MeasuredEdge edge;
  edge.extent = guess;
  ScanSettings settings;
  settings.reach_px = std::min(6.0, std::max(2.5, reach_px));
  // Along the guess, then again along the fitted line, with the edge's own blur and contrast.
  Segment line = guess;
  for (int round = 0; round < 2; ++round) {
    const EdgeScan scan(image, line);
    const std::vector<Sample> samples =
        samples_between(scan, target, scan.index_at(0.0), scan.index_at(line.length()), settings);
    if (samples.size() < pointing::kMinEdgePoints) return edge;
    std::vector<double> contrasts;
    for (const Sample& one : samples) contrasts.push_back(one.contrast);
    settings.contrast = median(contrasts);
    settings.blur = blur_of(scan, samples, settings.reach_px);
    settings.reach_px = reach_for(settings.blur, reach_px);
    const auto better = line_through(scan, samples, guess);
    if (!better) return edge;
    line = *better;
  }
  settings.max_off_px = kMaxOffLine_px;
  const EdgeScan scan(image, line);
  const int step = scan.direction();
  const int first = followed(scan, target, scan.index_at(0.0), -step, settings);
  const int last = followed(scan, target, scan.index_at(line.length()), step, settings);
  edge.extent = {scan.crossing(first), scan.crossing(last)};
  edge.blur_px = settings.blur;
  edge.cut = near_border(image, edge.extent.begin, kBorder_px + 1.5 * settings.reach_px) ||
             near_border(image, edge.extent.end, kBorder_px + 1.5 * settings.reach_px);
  const double corner = kCornerSigmas * settings.blur + 1.0;
  edge.corner_px = corner;
  std::vector<double> darks, contrasts, behind;
  std::array<ProfileStack, 2> halves;
  for (const Sample& one : samples_between(scan, target, first, last, settings)) {
    const Vector2 place = scan.place(one.index, one.across);
    if ((place - edge.extent.begin).norm() < corner || (place - edge.extent.end).norm() < corner) continue;
    edge.points.push_back({place, 1.0});
    contrasts.push_back(one.contrast);
    const bool second = 2 * std::abs(one.index - first) > std::abs(last - first);
    if (const auto profile = scan.profile(one.index, settings.reach_px)) {
      halves[second ? 1 : 0].add(*profile, one.rise, settings.blur);
      darks.push_back(dark_beyond(*profile, one.rise, settings.blur));
    }
    if (const auto wide = scan.profile(one.index, settings.reach_px + kBehind_px)) {
      if (const auto level = level_behind(*wide, one.rise, settings.reach_px)) behind.push_back(*level);
    }
  }
  const double excess_px = std::max(halves[0].excess_px(), halves[1].excess_px());
  edge.structure_px = std::sqrt(kShiftOfExcess * settings.blur * excess_px);
  if (darks.empty()) return edge;
  edge.contrast = median(contrasts);
  edge.backdrop = backdrop_of(behind, target.noise);
  edge.backing = (median(darks) - target.sky - kHalfNoise * target.noise) / edge.contrast;
  return edge;
}

}  // namespace pharos::pointing
