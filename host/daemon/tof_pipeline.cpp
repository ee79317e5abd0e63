// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/tof_pipeline.hpp"

#include <cmath>
#include <utility>

#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

constexpr double kNsPerSecond = 1e9;

std::string with_word(const std::string& words, const char* word) { return words.empty() ? word : words + '|' + word; }

}  // namespace

TofPipeline::TofPipeline(const TofConfig& config, const PublishConfig& publish, const std::string& source,
                         Publisher& publisher, Measure measure)
    : config_(config),
      source_(source),
      publisher_(publisher),
      measure_(std::move(measure)),
      max_age_ns_(std::llround(publish.max_age_s * kNsPerSecond)),
      log_(config.name),
      average_(config.average_frames) {}

/// When the frame was taken; empty, and counted, where it cannot be used.
std::optional<MappedTime> TofPipeline::time_of(const DepthFrame& frame) {
  const std::uint64_t ignored = clock_.map().counters().pairs_ignored;
  const std::optional<MappedTime> time = clock_.time_of(frame);
  if (clock_step_.update(clock_.map(), frame.complete_monotonic_ns)) {
    log_.warn("host clock", clock_step_.notice(frame.complete_monotonic_ns), frame.complete_monotonic_ns);
    last_utc_ns_ = 0;
  }
  if (!time) {
    ++(clock_.map().counters().pairs_ignored != ignored ? counters_.frames_time_back : counters_.frames_no_clock);
    return std::nullopt;
  }
  if (time->utc_ns <= last_utc_ns_) {
    ++counters_.frames_time_back;
    return std::nullopt;
  }
  last_utc_ns_ = time->utc_ns;
  return time;
}

void TofPipeline::take(const DepthFrame& frame) {
  const std::int64_t began_ns = monotonic_now_ns();
  rate_.on_data(frame.complete_monotonic_ns);
  transport_.add(frame.complete_monotonic_ns - frame.arrival_monotonic_ns);
  waiting_.add(began_ns - frame.complete_monotonic_ns);
  const PinholeCamera& intrinsics = config_.camera.intrinsics;
  if (frame.width_px != intrinsics.width_px || frame.height_px != intrinsics.height_px) {
    ++counters_.frames_wrong_size;
    return;
  }
  const std::optional<MappedTime> time = time_of(frame);
  if (!time) return;
  if (began_ns - time->monotonic_ns > max_age_ns_) {  // waited too long: the estimator has newer ones to work on
    ++counters_.frames_stale;
    return;
  }
  TofResult answered = measure_(frame);
  estimator_.add(monotonic_now_ns() - began_ns);
  for (std::size_t k = 0; k < tof::kTofStages; ++k) {
    if (answered.stage_ns[k] > 0) estimator_stages_[k].add(answered.stage_ns[k]);
  }
  if (frame.taken_in_turns) answered.flags = with_word(answered.flags, "in_turns");
  answer(answered, *time);
}

void TofPipeline::count(const TofResult& answer) {
  if (answer.refusal.empty()) {
    ++(answer.estimate.ambiguous() ? counters_.frames_ambiguous : counters_.frames_ok);
    return;
  }
  ++counters_.frames_refused;
  ++counters_.refused[answer.refusal];
  last_refusal_ = answer.refusal + ": " + answer.advice;
}

void TofPipeline::answer(const TofResult& answer, const MappedTime& time) {
  const bool has_pose = answer.refusal.empty();
  if (has_pose && !(answer.estimate.pose.is_finite() && answer.estimate.covariance.allFinite())) {
    ++counters_.frames_not_finite;
    return;
  }
  TofReport told = report(time);
  if (std::abs(told.latency_ns) > max_age_ns_) {
    ++counters_.frames_stale;
    return;
  }
  count(answer);
  told.refusal = answer.refusal;
  told.flags = answer.flags;
  told.observations = answer.observations;
  told.pose = answer.estimate;
  if (has_pose && config_.average_frames > 1) {
    if (answer.estimate.ambiguous()) return;  // which of the two would go into the mean?
    const auto mean = average_.push({answer.estimate, time.utc_ns, answer.observations, answer.flags});
    if (!mean) return;
    told.utc_ns = mean->utc_ns;
    told.flags = mean->moving ? with_word(mean->flags, "moving") : mean->flags;
    told.observations = mean->observations;
    told.pose = mean->estimate;
  }
  publish(told);
}

TofReport TofPipeline::report(const MappedTime& time) const {
  TofReport report;
  report.utc_ns = time.utc_ns;
  report.utc_sigma_ns = time.sigma_ns;
  report.latency_ns = monotonic_now_ns() - time.monotonic_ns;
  report.source = source_;
  report.camera = config_.name;
  report.target = config_.target;
  return report;
}

void TofPipeline::publish(TofReport& report) {
  report.sequence = sequence_++;
  const std::int64_t now_ns = monotonic_now_ns();
  if (!clock_step_.notice(now_ns).empty()) report.flags = with_word(report.flags, "clock_set");
  if (!publisher_.publish_pose(report) || !report.refusal.empty()) return;
  rate_.on_pose(now_ns);
  latency_.add(report.latency_ns);
}

}  // namespace pharos::host
