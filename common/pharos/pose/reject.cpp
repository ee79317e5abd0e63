// SPDX-License-Identifier: Apache-2.0
#include "pharos/pose/reject.hpp"

#include "pharos/pose/p3p.hpp"
#include "pharos/pose/place_residuals.hpp"
#include "pharos/pose/refine.hpp"

namespace pharos::pose {
namespace {

constexpr int kMaxTriplets = 30;
constexpr int kMaxHitsPerTriplet = 8;
constexpr int kConcentrationSteps = 2;
// A start whose first core costs this many times the best one's final core is not refined.
constexpr double kNotWorthSteps = 1e4;
// A pose whose sum of squares over all hits is within this many times the plausible one gets a fit to all of them.
constexpr double kWorthAFit = 100.0;

class TrimmedSearch {
 public:
  TrimmedSearch(HitCandidates& hits, const SolveOptions& options) : hits_(hits), options_(options) {}

  /// Concentration: pick the core, take a Gauss-Newton step, pick again.
  void consider(const LighthouseFromBody& start);
  /// Triplets of sensors with both bearings: all of them where few, else spread evenly over all by a stride.
  void consider_triplets();

  const LighthouseFromBody& best() const { return best_; }
  bool found() const { return best_cost_ < 1e300; }
  /// All places agree on the best pose: there is nothing to reject, and the search ends.
  bool complete() const { return complete_; }
  /// The limit of starts is reached.
  bool cut_short() const { return starts_ >= options_.max_search_starts; }

 private:
  void consider_triplet(const Triplet& sensors);
  RaySet rays_of_hits(const Triplet& sensors, const std::array<std::int16_t, 6>& hit) const;
  bool next_combination(const Triplet& sensors, std::array<std::int16_t, 6>& hit) const;
  double cost_threshold(int places) const;
  bool all_places_agree(const PlaceResiduals& residuals, const LighthouseFromBody& pose);

  HitCandidates& hits_;
  const SolveOptions& options_;
  LighthouseFromBody best_;
  double best_cost_ = 1e300;
  bool complete_ = false;
  int starts_ = 0;
};

double TrimmedSearch::cost_threshold(int places) const {
  return chi2_threshold(places - kPoseUnknowns) * options_.sigma_rad * options_.sigma_rad;
}

bool TrimmedSearch::all_places_agree(const PlaceResiduals& residuals, const LighthouseFromBody& pose) {
  const int places = static_cast<int>(residuals.size());
  const double variance = options_.sigma_rad * options_.sigma_rad;
  const double credible = cost_threshold(places);
  double cost = 0.0;
  for (const PlaceResidual& r : residuals) cost += r.size * r.size;
  if (cost > kWorthAFit * credible) return false;
  choose_first(hits_, residuals, places);
  const Fit fit =
      refine(hits_.table, pose, Residual::kAngle, {options_.max_iterations, kConvergedFraction * variance, 1e300});
  if (!fit.converged() || fit.normal.cost > credible) return false;
  best_ = fit.state;
  return true;
}

void TrimmedSearch::consider(const LighthouseFromBody& start) {
  if (cut_short()) return;
  ++starts_;
  PlaceResiduals residuals;
  LighthouseFromBody pose = start;
  for (int step = 0; !complete_; ++step) {
    sort_places(hits_, pose, residuals);
    const int core = core_size(static_cast<int>(residuals.size()));
    const double cost = choose_first(hits_, residuals, core);
    // A pose that all places agree on is accepted, even if another one's core fits better: of few sensors eight places
    // of twelve can fit a wrong pose as well as the true one.
    const bool best = cost < best_cost_;
    if (best) best_ = pose, best_cost_ = cost;
    if (step > 0 && (best || cost <= cost_threshold(core))) {
      complete_ = all_places_agree(residuals, pose);
      if (!complete_) choose_first(hits_, residuals, core);  // the next step is the core's
    }
    if (complete_ || step == kConcentrationSteps || cost > kNotWorthSteps * best_cost_) return;
    pose = gauss_newton_step(hits_.table, pose, Residual::kAngle);
  }
}

RaySet TrimmedSearch::rays_of_hits(const Triplet& sensors, const std::array<std::int16_t, 6>& hit) const {
  RaySet set;
  set.count = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto x = static_cast<std::size_t>(hit[2 * k]), y = static_cast<std::size_t>(hit[2 * k + 1]);
    set.body[k] = hits_.table.body(sensors[k]);
    set.ray[k] = ray_of(hits_.cosine[x], hits_.sine[x], hits_.cosine[y], hits_.sine[y]);
  }
  return set;
}

// Counts up through the hits of the six places; false after the last.
bool TrimmedSearch::next_combination(const Triplet& sensors, std::array<std::int16_t, 6>& hit) const {
  for (std::size_t digit = 0; digit < 6; ++digit) {
    hit[digit] = hits_.next[static_cast<std::size_t>(hit[digit])];
    if (hit[digit] != HitCandidates::kNone) return true;
    hit[digit] = hits_.at(sensors[digit / 2], static_cast<Axis>(digit % 2)).first;
  }
  return false;
}

void TrimmedSearch::consider_triplet(const Triplet& sensors) {
  std::array<std::int16_t, 6> hit;
  for (std::size_t k = 0; k < 6; ++k) hit[k] = hits_.at(sensors[k / 2], static_cast<Axis>(k % 2)).first;
  for (int combination = 0; combination < kMaxHitsPerTriplet && !complete_ && !cut_short(); ++combination) {
    for (const LighthouseFromBody& start : p3p(rays_of_hits(sensors, hit), {0, 1, 2})) consider(start);
    if (!next_combination(sensors, hit)) return;
  }
}

void TrimmedSearch::consider_triplets() {
  StaticVector<int, kMaxSensors> full;
  for (int i = 0; i < hits_.sensors(); ++i) {
    const bool both =
        hits_.at(i, Axis::kX).first != HitCandidates::kNone && hits_.at(i, Axis::kY).first != HitCandidates::kNone;
    if (both) full.push_back(i);
  }
  const std::size_t n = full.size();
  const std::size_t all = n < 3 ? 0 : n * (n - 1) * (n - 2) / 6;
  const std::size_t stride = 1 + all / (kMaxTriplets + 1);
  std::size_t number = 0;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n && !complete_ && !cut_short(); ++c) {
        if (number++ % stride == 0) consider_triplet({full[a], full[b], full[c]});
      }
    }
  }
}

}  // namespace

Search fit_rigid_body(HitCandidates& hits, const StartPoses& starts, const SolveOptions& options,
                      LighthouseFromBody& pose) {
  TrimmedSearch search(hits, options);
  for (const LighthouseFromBody& start : starts) search.consider(start);
  search.consider_triplets();
  if (!search.found()) return search.cut_short() ? Search::kCutShort : Search::kNoStart;
  pose = search.best();
  if (search.complete()) return Search::kDone;
  readmit_inliers(hits, options, pose);
  return search.cut_short() ? Search::kCutShort : Search::kDone;
}

}  // namespace pharos::pose
