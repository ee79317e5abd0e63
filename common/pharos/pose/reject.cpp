// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/reject.hpp"

#include <algorithm>
#include <cmath>

#include "pharos/pose/p3p.hpp"

namespace pharos::pose {
namespace {

constexpr int kUnknowns = 6;
// One row more than unknowns: the least that can contradict itself.
constexpr int kLeastCore = kUnknowns + 1;
constexpr int kMaxTriplets = 40;
constexpr int kMaxHitsPerTriplet = 8;
constexpr int kConcentrationSteps = 2;
constexpr int kFinalRounds = 8;
// Share of places in the core: up to a third may be reflections.
constexpr int kCoreNumerator = 2, kCoreDenominator = 3;
constexpr std::size_t kMaxPlaces = kAxes * kMaxSensors;

// A hit is let in below this many times the scale: Student's 99.9 % quantile for the degrees of freedom that the scale
// was estimated from, the first cut from 637 to what a reflection must stand out by at sigma, the last ones raised to 5
// so that one good hit in two million is lost.
double gate_for(int degrees_of_freedom) {
  constexpr std::array<double, 7> kGates{60.0, 60.0, 31.6, 12.9, 8.6, 6.9, 6.0};
  const int last = static_cast<int>(kGates.size()) - 1;
  return degrees_of_freedom > last ? 5.0 : kGates[static_cast<std::size_t>(std::max(0, degrees_of_freedom))];
}

struct PlaceResidual {
  double size;  // |residual| of the best hit, rad
  std::int16_t observation;
  std::uint8_t sensor;
  Axis axis;
};

using PlaceResiduals = StaticVector<PlaceResidual, kMaxPlaces>;

PlaceResidual best_hit(const Hits& hits, int sensor, Axis axis, double along, double ahead) {
  PlaceResidual best{1e300, Hits::kNone, static_cast<std::uint8_t>(sensor), axis};
  for (std::int16_t o = hits.at(sensor, axis).first; o != Hits::kNone; o = hits.next[static_cast<std::size_t>(o)]) {
    const auto k = static_cast<std::size_t>(o);
    const double size = std::fabs(angle_residual(along, ahead, hits.cosine[k], hits.sine[k]));
    if (size < best.size) {
      best.size = size;
      best.observation = o;
    }
  }
  return best;
}

// The hit of every place that fits the pose best, best places first.
void sort_places(const Hits& hits, const LighthouseFromBody& pose, PlaceResiduals& residuals) {
  residuals.clear();
  for (int i = 0; i < hits.sensors(); ++i) {
    const Vector3 p = pose * hits.sightings.body(i);
    for (const Axis axis : {Axis::kX, Axis::kY}) {
      const PlaceResidual best = best_hit(hits, i, axis, p[index_of(axis)], p.z());
      if (best.observation != Hits::kNone) residuals.push_back(best);
    }
  }
  std::sort(residuals.begin(), residuals.end(),
            [](const PlaceResidual& a, const PlaceResidual& b) { return a.size < b.size; });
}

int core_size(int places) {
  const int share = (kCoreNumerator * places + kCoreDenominator - 1) / kCoreDenominator;
  return std::min(places, std::max(kLeastCore, share));
}

// Puts the first `count` places into the sightings and leaves the others out; the sum of their squares.
double choose_first(Hits& hits, const PlaceResiduals& residuals, int count) {
  double sum = 0.0;
  for (int k = 0; k < static_cast<int>(residuals.size()); ++k) {
    const PlaceResidual& r = residuals[static_cast<std::size_t>(k)];
    hits.choose(r.sensor, r.axis, k < count ? r.observation : Hits::kNone);
    if (k < count) sum += r.size * r.size;
  }
  return sum;
}

struct Core {
  LighthouseFromBody pose;
  double cost = 1e300;
};

// Concentration: pick the core, take a Gauss-Newton step, pick again.
void consider(Hits& hits, const LighthouseFromBody& start, Core& best) {
  PlaceResiduals residuals;
  LighthouseFromBody pose = start;
  for (int step = 0;; ++step) {
    sort_places(hits, pose, residuals);
    const double cost = choose_first(hits, residuals, core_size(static_cast<int>(residuals.size())));
    if (cost < best.cost) best = {pose, cost};
    if (step == kConcentrationSteps) return;
    const RefineLimits limits{1, 0.0, 1e300};
    pose = refine(hits.sightings, pose, Residual::kAngle, limits).pose;
  }
}

// Rays of three sensors with every combination of their hits, at most kMaxHitsPerTriplet.
void consider_triplet(Hits& hits, const Triplet& sensors, Core& best) {
  std::array<std::int16_t, 6> hit;
  for (std::size_t k = 0; k < 6; ++k) hit[k] = hits.at(sensors[k / 2], static_cast<Axis>(k % 2)).first;
  for (int combination = 0; combination < kMaxHitsPerTriplet; ++combination) {
    RaySet set;
    set.count = 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<std::size_t>(hit[2 * k]), y = static_cast<std::size_t>(hit[2 * k + 1]);
      set.body[k] = hits.sightings.body(sensors[k]);
      set.ray[k] = Vector3(hits.cosine[x] * hits.sine[y], hits.cosine[y] * hits.sine[x], hits.sine[x] * hits.sine[y])
                       .normalized();
    }
    for (const LighthouseFromBody& start : p3p(set, {0, 1, 2})) consider(hits, start, best);
    std::size_t digit = 0;  // counts up through the hits of the six places
    for (; digit < 6; ++digit) {
      hit[digit] = hits.next[static_cast<std::size_t>(hit[digit])];
      if (hit[digit] != Hits::kNone) break;
      hit[digit] = hits.at(sensors[digit / 2], static_cast<Axis>(digit % 2)).first;
    }
    if (digit == 6) return;
  }
}

// Triplets of sensors with both bearings: all of them where few, else spread evenly over all by a stride.
void consider_triplets(Hits& hits, Core& best) {
  std::array<int, kMaxSensors> full{};
  int count = 0;
  for (int i = 0; i < hits.sensors(); ++i) {
    if (hits.at(i, Axis::kX).first != Hits::kNone && hits.at(i, Axis::kY).first != Hits::kNone) {
      full[static_cast<std::size_t>(count++)] = i;
    }
  }
  const int all = count * (count - 1) * (count - 2) / 6;
  const int stride = 1 + all / (kMaxTriplets + 1);
  int number = 0;
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      for (int c = b + 1; c < count; ++c) {
        if (number++ % stride != 0) continue;
        consider_triplet(
            hits,
            {full[static_cast<std::size_t>(a)], full[static_cast<std::size_t>(b)], full[static_cast<std::size_t>(c)]},
            best);
      }
    }
  }
}

// Residual of a place over what noise and the pose's own uncertainty make of it, in units of the scale.
double studentised(const Hits& hits, const PlaceResidual& place, const LighthouseFromBody& pose,
                   const Factorisation<6>& factor) {
  Sightings one;
  one.count = 0;
  one.add(hits.sightings.body(place.sensor));
  const auto k = static_cast<std::size_t>(place.observation);
  one.see(0, place.axis, hits.cosine[k], hits.sine[k]);
  const Vector6 j = row_of(one, 0, place.axis, pose, Residual::kAngle).jacobian;
  const std::array<double, 6> x = factor.solve({j[0], j[1], j[2], j[3], j[4], j[5]});
  double leverage = 0.0;
  for (int i = 0; i < 6; ++i) leverage += j[i] * x[static_cast<std::size_t>(i)];
  return place.size / std::sqrt(1.0 + std::fmax(0.0, leverage));
}

// Lets hits in again by the gate until the set no longer changes.
void grow(Hits& hits, const SolveOptions& options, LighthouseFromBody& pose) {
  PlaceResiduals residuals;
  sort_places(hits, pose, residuals);
  int chosen = core_size(static_cast<int>(residuals.size()));
  choose_first(hits, residuals, chosen);
  const RefineLimits limits{options.max_iterations, kConvergedShare * options.sigma_rad * options.sigma_rad, 1e300};
  for (int round = 0; round < kFinalRounds; ++round) {
    const Fit fit = refine(hits.sightings, pose, Residual::kAngle, limits);
    pose = fit.pose;
    const int freedom = chosen - kUnknowns;
    const double scale =
        std::fmax(options.sigma_rad, freedom > 0 ? std::sqrt(fit.normal.cost / static_cast<double>(freedom)) : 0.0);
    const double gate = gate_for(freedom) * scale;
    const Factorisation<6> factor(fit.normal.matrix);
    sort_places(hits, pose, residuals);
    int passing = 0;
    bool changed = false;
    for (PlaceResidual& r : residuals) {
      const bool was_in = hits.at(r.sensor, r.axis).chosen == r.observation;
      const bool in = was_in ? r.size <= gate : studentised(hits, r, pose, factor) <= gate;
      changed = changed || in != was_in;
      passing += in ? 1 : 0;
      hits.choose(r.sensor, r.axis, in ? r.observation : Hits::kNone);
    }
    if (!changed) return;
    chosen = passing;
  }
}

}  // namespace

double credible_chi2(int degrees_of_freedom) {
  const double n = static_cast<double>(degrees_of_freedom);
  return n + 4.0 * std::sqrt(2.0 * n) + 8.0;
}

bool fit_rigid_body(Hits& hits, const StartPoses& starts, const SolveOptions& options, LighthouseFromBody& pose) {
  Core best;
  for (const LighthouseFromBody& start : starts) consider(hits, start, best);
  consider_triplets(hits, best);
  if (!(best.cost < 1e300)) return false;
  pose = best.pose;
  grow(hits, options, pose);
  return true;
}

}  // namespace pharos::pose
