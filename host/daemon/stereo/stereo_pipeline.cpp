// SPDX-License-Identifier: Apache-2.0
#include "host/daemon/stereo/stereo_pipeline.hpp"

#include "host/publish/messages.hpp"
#include "host/publish/words.hpp"

namespace pharos::host {
namespace {

constexpr const char* kPairsLost =
    "frames are lost on the network or have no partner: see frames_... and frames_without_partner of each side";

}  // namespace

StereoPipeline::StereoPipeline(const StereoConfig& config, const PublishConfig& publish, const std::string& source,
                               Publisher& publisher, const Clock& clock)
    : name_(config.name),
      target_(config.target),
      source_(source),
      clock_(clock),
      is_loose_(config.is_loose()),
      log_(source),
      gate_(publisher, counters_.pairs_not_finite, PublishGate::AgeLimit{publish.max_age_ns(), counters_.pairs_stale}),
      spin_gate_(publisher, counters_.spins_not_finite,
                 PublishGate::AgeLimit{publish.max_age_ns(), counters_.pairs_stale}),
      delivery_("pairs", kPairsLost),
      changes_(kSilence_ns) {}

bool StereoPipeline::take(const StereoPair& pair) {
  const std::int64_t now_ns = clock_.monotonic_ns();
  rate_.on_data(now_ns);
  const bool fresh = gate_.fresh(now_ns - pair.time.monotonic_ns);
  if (!fresh) delivery_.on_answer(false, now_ns);
  return fresh;
}

// Logs a refusal that differs from the last one, and the first pose after it; repetitions are not logged.
void StereoPipeline::count(const StereoReport& report, std::int64_t monotonic_ns) {
  if (report.answered()) {
    ++(report.ambiguous ? counters_.pairs_ambiguous : counters_.pairs_ok);
    if (!last_refusal_.empty()) log_.info("answered", "poses again", monotonic_ns);
    last_refusal_.clear();
    return;
  }
  ++counters_.pairs_refused;
  ++counters_.refused[report.refusal];
  const std::string refusal = report.refusal + ": " + report.advice;
  if (refusal != last_refusal_) log_.warn("refused", refusal, monotonic_ns);
  last_refusal_ = refusal;
}

StereoReport StereoPipeline::report_of(const StereoPair& pair, const PairResult& answer) const {
  StereoReport report(answer.pose);
  static_cast<MeasurementOutcome&>(report) = answer;
  report.utc_ns = pair.time.utc_ns;
  report.utc_sigma_ns = pair.time.sigma_ns;
  report.age_ns = clock_.monotonic_ns() - pair.time.monotonic_ns;
  report.source = source_;
  report.sensor = name_;
  report.target = target_;
  return report;
}

// Ring2 only: slam has its own limit on motion. Recorded pairs are not checked, as they may be of different views.
void StereoPipeline::refuse_jump(StereoReport& report, std::int64_t time_ns) {
  const auto* const pose = std::get_if<Ring2PoseEstimate>(&report.pose);
  if (is_loose_ || pose == nullptr || !report.answered() || report.ambiguous) return;
  if (jump_check_.passes(*pose, time_ns)) return;
  report.refusal = kJumpRefusal;
  report.advice = kJumpAdvice;
  report.pose = Ring2PoseEstimate{};
}

void StereoPipeline::publish_spin(const StereoReport& report, const SpinResult& answer) {
  SpinReport spin;
  static_cast<MeasurementHeader&>(spin) = report;
  spin.ambiguous = false;
  spin.refusal = answer.refusal;
  spin.spin = answer.spin;
  spin_gate_.publish(spin);
}

std::optional<StereoReport> StereoPipeline::done(const PairWorker::Done& done, bool clock_was_set) {
  const PairResult& answer = done.answer;
  waiting_.add(done.waited_ns);
  estimator_.add(done.took_ns);
  for (const StageTime& time : answer.stages) stages_[time.stage].add(time.ns);
  if (!answer.figures.empty()) figures_ = answer.figures;
  StereoReport report = report_of(*done.job, answer);
  const std::int64_t now_ns = clock_.monotonic_ns();
  const bool passes = gate_.passes(report);
  if (passes) refuse_jump(report, done.job->time.monotonic_ns);
  delivery_.on_answer(passes && report.answered(), now_ns);
  if (!passes) return std::nullopt;
  count(report, now_ns);
  if (clock_was_set) add_flag_word(report.flags, kClockSetWord);
  if (answer.spin) publish_spin(report, *answer.spin);
  if (!gate_.publish(report) || !report.answered()) return report;
  rate_.on_pose(now_ns);
  latency_.add(report.age_ns);
  return report;
}

}  // namespace pharos::host
