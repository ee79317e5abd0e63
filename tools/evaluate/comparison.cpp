// SPDX-License-Identifier: Apache-2.0
#include "tools/evaluate/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "tools/evaluate/time_offset.hpp"

namespace pharos::evaluate {
namespace {

constexpr double kMaxGapIntervals = 3.5;  // two lost samples are bridged
constexpr double kMinExtent_m = 1e-3;
constexpr std::size_t kMinPairsToAlign = 10;

using EstimateTrajectory = Trajectory<EstimatePose>;
using TruthTrajectory = Trajectory<TruthPose>;

Comparison refusal(Comparison so_far, const char* word, std::string why) {
  so_far.refused = word;
  so_far.why = std::move(why);
  return so_far;
}

std::string span_words(double first_s, double last_s) {
  return std::to_string(first_s) + " to " + std::to_string(last_s) + " s";
}

/// Both closed forms, refined; the better one.
Aligned hand_eye(const EstimateTrajectory& estimate, const TruthTrajectory& truth, double time_offset_s, bool free_time,
                 double max_gap_s) {
  const Pairs pairs = pair_up(estimate, truth, time_offset_s, max_gap_s);
  std::optional<Aligned> best;
  for (Alignment start : {hand_eye_start(pairs.pairs), path_start(pairs.pairs)}) {
    start.time_offset_s = time_offset_s;
    const Aligned refined = align(estimate, truth, start, {true, true, free_time}, max_gap_s);
    if (!best || refined.cost < best->cost) best = refined;
  }
  return *best;
}

Aligned aligned_as_asked(const EstimateTrajectory& estimate, const TruthTrajectory& truth, double time_offset_s,
                         const ComparisonOptions& options, double max_gap_s) {
  const bool free_time = !options.time_offset_s;
  if (options.mode == AlignMode::kHandEye) return hand_eye(estimate, truth, time_offset_s, free_time, max_gap_s);
  Alignment start = options.known.value_or(Alignment{});
  start.time_offset_s = time_offset_s;
  if (options.mode == AlignMode::kNone) {
    return free_time ? align(estimate, truth, start, {false, false, true}, max_gap_s) : Aligned{start, {}, 0.0};
  }
  const auto fit = [&](Alignment alignment) {
    const Pairs pairs = pair_up(estimate, truth, alignment.time_offset_s, max_gap_s);
    alignment.world = se3_of_positions(pairs.pairs, alignment).world;
    return alignment;
  };
  start = fit(start);
  if (!free_time) return {start, {}, 0.0};
  Aligned refined = align(estimate, truth, start, {true, false, true}, max_gap_s);
  refined.alignment = fit(refined.alignment);
  return refined;
}

/// Why an alignment is not reliable; empty where it is.
std::string too_little_motion(const Comparison& c, const ComparisonOptions& options) {
  if (options.mode == AlignMode::kSe3) {
    const double across = se3_of_positions(c.pairs.pairs, c.aligned.alignment).second_extent_m;
    if (across < kMinExtent_m) return "TRUTH's positions lie on one line or point: the turn about it is open";
  }
  for (const UnobservableDirection& open : c.aligned.open) {
    if (open.turns() || std::abs(open.time) > 0.5) return "the motion leaves open " + open.words();
  }
  return {};
}

/// Refusals that need no computation.
std::optional<Comparison> unusable(const TrajectoryFile<EstimatePose>& estimate,
                                   const TrajectoryFile<TruthPose>& truth) {
  if (estimate.samples.empty()) {
    return refusal({}, "refused_no_pose",
                   estimate.rows == 0 ? "ESTIMATE holds no row" : "ESTIMATE holds no usable pose");
  }
  if (truth.samples.empty()) return refusal({}, "refused_no_truth", "TRUTH holds no usable pose");
  return std::nullopt;
}

Comparison with_figures(Comparison c, const TrajectoryFile<EstimatePose>& estimate, const TruthTrajectory& truth,
                        const ComparisonOptions& options) {
  const double offset_s = c.aligned.alignment.time_offset_s;
  const CommonSpan span{std::max(estimate.first_s, truth.front().time_s - offset_s),
                        std::min(estimate.last_s, truth.back().time_s - offset_s)};
  c.figures = figures_of(c.pairs.pairs, c.aligned.alignment, span, options.relative_s, c.coverage_gap_s);
  return c;
}

}  // namespace

Comparison compare(const TrajectoryFile<EstimatePose>& estimate, const TrajectoryFile<TruthPose>& truth,
                   const ComparisonOptions& options) {
  if (auto refused = unusable(estimate, truth)) return *refused;
  Comparison c;
  c.max_gap_s = options.max_gap_s.value_or(kMaxGapIntervals * median_interval_s(truth.samples));
  c.coverage_gap_s = kMaxGapIntervals * median_interval_s(estimate.samples);
  double offset_s = options.time_offset_s.value_or(0.0);
  if (!options.time_offset_s) {
    const CoarseOffset coarse = coarse_time_offset(estimate.samples, truth.samples);
    if (!coarse.offset_s) return refusal(c, "refused_time_offset", coarse.why + "; give --time-offset SECONDS");
    offset_s = *coarse.offset_s;
  }
  c.pairs = pair_up(estimate.samples, truth.samples, offset_s, c.max_gap_s);
  if (c.pairs.pairs.empty()) {
    return refusal(c, "refused_no_overlap",
                   "no pose of ESTIMATE (" + span_words(estimate.first_s, estimate.last_s) +
                       ") falls where TRUTH knows one (" + span_words(truth.first_s, truth.last_s) +
                       "); give --time-offset auto or SECONDS to add to ESTIMATE's times");
  }
  const bool aligning = options.mode != AlignMode::kNone || !options.time_offset_s;
  if (aligning && c.pairs.pairs.size() < kMinPairsToAlign) {
    return refusal(c, "refused_too_few_poses", "fewer than 10 poses of ESTIMATE meet TRUTH: too few to align");
  }
  c.aligned = aligned_as_asked(estimate.samples, truth.samples, offset_s, options, c.max_gap_s);
  c.pairs = pair_up(estimate.samples, truth.samples, c.aligned.alignment.time_offset_s, c.max_gap_s);
  if (aligning) {
    const std::string little = c.pairs.pairs.empty() ? "the fit ran away" : too_little_motion(c, options);
    if (!little.empty()) {
      return refusal(c, "refused_too_little_motion",
                     little + "; record a motion that turns about two axes, or align with less");
    }
  }
  return with_figures(std::move(c), estimate, truth.samples, options);
}

}  // namespace pharos::evaluate
