// SPDX-License-Identifier: Apache-2.0
#include "host/vision/pointing/edge_scan.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pointing {
namespace {

constexpr double kMinContrast = 0.5;  // of the edge's median
constexpr double kMaxContrast = 1.6;
constexpr double kDarkness = 0.25;  // of the contrast: tolerance for the dark side to be sky
constexpr int kMaxMisses = 3;       // in a row: an edge ends there

std::optional<EdgeSample> sample(const EdgeScan& scan, const TargetMask& target, int index,
                                 const ScanSettings& settings) {
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
  return EdgeSample{index, rise->place, contrast, rise->dark, *rise};
}

}  // namespace

EdgeScan::EdgeScan(ImageView<const std::uint16_t> image, const Segment& line) : image_(image), line_(line) {
  const Vector2 across = line.across();
  along_rows_ = std::abs(across.x()) >= std::abs(across.y());  // the profile is part of a row
  slope_ = along_rows_ ? across.x() : across.y();
  const Vector2 d = line.along();
  step_ = along_rows_ ? d.y() : d.x();
}

int EdgeScan::index_at(double station) const {
  const Vector2 place = line_.begin + station * line_.along();
  return static_cast<int>(std::lround(along_rows_ ? place.y() : place.x()));
}

Vector2 EdgeScan::crossing(int index) const {
  const Vector2 d = line_.along();
  const double from = along_rows_ ? line_.begin.y() : line_.begin.x();
  return line_.begin + (index - from) / step_ * d;
}

std::optional<Profile> EdgeScan::profile(int index, double reach_px) const {
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

Vector2 EdgeScan::place(int index, double across) const {
  Vector2 result = crossing(index);
  (along_rows_ ? result.x() : result.y()) += across / slope_;
  return result;
}

std::vector<EdgeSample> samples_between(const EdgeScan& scan, const TargetMask& target, int from, int to,
                                        const ScanSettings& settings) {
  std::vector<EdgeSample> samples;
  const int step = scan.direction();
  for (int index = from; step * (to - index) >= 0; index += step) {
    if (const auto one = sample(scan, target, index, settings)) samples.push_back(*one);
  }
  return samples;
}

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

}  // namespace pharos::pointing
