// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/place_residuals.hpp"

#include <algorithm>
#include <cmath>

namespace pharos::pose {
namespace {

constexpr int kCoreNumerator = 2, kCoreDenominator = 3;
constexpr int kMinCore = kPoseUnknowns + 1;
// Used for the tangent of a residual beyond 90 deg.
constexpr double kOppositeSide = 1e6;

PlaceResidual best_hit(const HitCandidates& hits, int sensor, Axis axis, double along, double ahead) {
  PlaceResidual best{2.0 * kOppositeSide, HitCandidates::kNone, static_cast<std::uint8_t>(sensor), axis};
  for (std::int16_t o = hits.at(sensor, axis).first; o != HitCandidates::kNone;
       o = hits.next[static_cast<std::size_t>(o)]) {
    const auto k = static_cast<std::size_t>(o);
    const double adjacent = along * hits.cosine[k] + ahead * hits.sine[k];
    const double opposite = std::fabs(ahead * hits.cosine[k] - along * hits.sine[k]);
    const double size = adjacent > 0.0 ? opposite / adjacent : kOppositeSide;
    if (size < best.size) {
      best.size = size;
      best.observation = o;
    }
  }
  return best;
}

}  // namespace

void sort_places(const HitCandidates& hits, const LighthouseFromBody& pose, PlaceResiduals& residuals) {
  residuals.clear();
  for (int i = 0; i < hits.sensors(); ++i) {
    const Vector3 p = pose * hits.table.body(i);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const PlaceResidual best = best_hit(hits, i, axis, p[index_of(axis)], p.z());
      if (best.observation != HitCandidates::kNone) residuals.push_back(best);
    }
  }
  std::sort(residuals.begin(), residuals.end(),
            [](const PlaceResidual& a, const PlaceResidual& b) { return a.size < b.size; });
}

double choose_first(HitCandidates& hits, const PlaceResiduals& residuals, int count) {
  double sum = 0.0;
  for (int k = 0; k < static_cast<int>(residuals.size()); ++k) {
    const PlaceResidual& r = residuals[static_cast<std::size_t>(k)];
    hits.choose(r.sensor, r.axis, k < count ? r.observation : HitCandidates::kNone);
    if (k < count) sum += r.size * r.size;
  }
  return sum;
}

int core_size(int places) {
  const int fraction = (kCoreNumerator * places + kCoreDenominator - 1) / kCoreDenominator;
  return std::min(places, std::max(kMinCore, fraction));
}

double chi2_threshold(int degrees_of_freedom) {
  const double n = std::max(0, degrees_of_freedom);
  return n + 4.0 * std::sqrt(2.0 * n) + 8.0;
}

}  // namespace pharos::pose
