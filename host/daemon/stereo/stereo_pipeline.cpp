// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/stereo_pipeline.hpp"

#include <cmath>
#include <utility>

#include "host/runtime/now.hpp"

namespace pharos::host {
namespace {

constexpr double kNsPerSecond = 1e9;

}  // namespace

StereoPipeline::StereoPipeline(const StereoConfig& config, const PublishConfig& publish, const std::string& source,
                               Publisher& publisher)
    : name_(config.name),
      target_(config.target),
      source_(source),
      publisher_(publisher),
      max_age_ns_(std::llround(publish.max_age_s * kNsPerSecond)),
      log_(source) {}

bool StereoPipeline::stale(std::int64_t age_ns) const { return std::abs(age_ns) > max_age_ns_; }

bool StereoPipeline::take(const StereoPair& pair) {
  const std::int64_t now_ns = monotonic_now_ns();
  rate_.on_data(now_ns);
  if (!stale(now_ns - pair.time.monotonic_ns)) return true;
  ++counters_.pairs_stale;
  return false;
}

// What is told of one refusal, and that it is over, goes to the log; what repeats does not.
void StereoPipeline::count(const PairResult& answer, std::int64_t monotonic_ns) {
  if (answer.refusal.empty()) {
    const bool ambiguous = std::visit([](const auto& pose) { return pose.ambiguous(); }, answer.pose);
    ++(ambiguous ? counters_.pairs_ambiguous : counters_.pairs_ok);
    if (!last_refusal_.empty()) log_.info("answered", "poses again", monotonic_ns);
    last_refusal_.clear();
    return;
  }
  ++counters_.pairs_refused;
  ++counters_.refused[answer.refusal];
  const std::string told = answer.refusal + ": " + answer.advice;
  if (told != last_refusal_) log_.warn("refused", told, monotonic_ns);
  last_refusal_ = told;
}

StereoReport StereoPipeline::report(const StereoPair& pair, const PairResult& answer) const {
  StereoReport report;
  report.utc_ns = pair.time.utc_ns;
  report.utc_sigma_ns = pair.time.sigma_ns;
  report.latency_ns = monotonic_now_ns() - pair.time.monotonic_ns;
  report.sequence = sequence_;
  report.source = source_;
  report.camera = name_;
  report.target = target_;
  report.flags = answer.flags;
  report.observations = answer.observations;
  report.refusal = answer.refusal;
  report.pose = answer.pose;
  return report;
}

void StereoPipeline::publish_spin(const StereoReport& told, const SpinResult& answer) {
  SpinReport report{told, answer.spin};
  report.refusal = answer.refusal;
  report.sequence = spin_sequence_++;
  publisher_.publish_spin(report);
}

void StereoPipeline::done(const PairWorker::Done& done, bool clock_was_set) {
  const PairResult& answer = done.answer;
  waiting_.add(done.waited_ns);
  estimator_.add(done.took_ns);
  for (const StageTime& time : answer.stages) stages_[time.stage].add(time.ns);
  if (!answer.figures.empty()) figures_ = answer.figures;
  const bool finite =
      std::visit([](const auto& pose) { return pose.pose.is_finite() && pose.covariance.allFinite(); }, answer.pose);
  if (answer.refusal.empty() && !finite) {
    ++counters_.pairs_not_finite;
    return;
  }
  StereoReport told = report(*done.job, answer);
  if (stale(told.latency_ns)) {
    ++counters_.pairs_stale;
    return;
  }
  const std::int64_t now_ns = monotonic_now_ns();
  count(answer, now_ns);
  ++sequence_;
  if (clock_was_set) told.flags += told.flags.empty() ? "clock_set" : "|clock_set";
  if (answer.spin) publish_spin(told, *answer.spin);
  if (!publisher_.publish_pose(told) || !told.refusal.empty()) return;
  rate_.on_pose(now_ns);
  latency_.add(told.latency_ns);
}

}  // namespace pharos::host
